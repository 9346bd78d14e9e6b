#include "plugins/json_log/json_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "plugins/common/logs/log_line.hpp"
#include "plugins/common/logs/log_text.hpp"

namespace cairn::json_log {
namespace {

using log_common::ScanLog;
using nlohmann::json;

// The characters of a text for the parser, which asks for one after the other; the budget is looked at now and then.
class BudgetedCharacters {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  BudgetedCharacters(const char* at, const Budget& budget, const std::string& file)
      : at_(at), budget_(&budget), file_(&file) {}
  reference operator*() const { return *at_; }
  BudgetedCharacters& operator++() {
    constexpr std::size_t kLookEvery = std::size_t{1} << 16U;
    ++at_;
    if (++passed_ % kLookEvery == 0) log_common::check_budget(*budget_, *file_);
    return *this;
  }
  bool operator==(const BudgetedCharacters& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const Budget* budget_;
  const std::string* file_;
  std::size_t passed_ = 0;
};

json parsed(const std::string& text, const std::string& file, const Budget& budget) {
  return json::parse(BudgetedCharacters(text.data(), budget, file),
                     BudgetedCharacters(text.data() + text.size(), budget, file));
}

class Reader {
 public:
  Reader(const Config& config, const Budget& budget)
      : config_(config), budget_(budget), scans_(config.file.string(), config, budget) {
    log_common::check_limits(config.file, "laser", config.laser);
  }
  ScanLog read();

 private:
  [[nodiscard]] json root();
  void read_scan(double stamp_s, const json& scan);
  [[nodiscard]] ConfigError fault(const std::string& stamp, const std::string& sentence) const {
    return {{config_.file.string(), 0, 0}, "at stamp " + in_quotes(stamp) + ": " + sentence};
  }

  const Config& config_;
  const Budget& budget_;
  ScanLog scans_;
  std::optional<Pose2> T_log_laser_;  // of the last scan that has one
};

double number_in(const json& value, const std::string& what) {
  if (!value.is_number()) throw std::runtime_error(what + " must be a number");
  return value.get<double>();
}

double metres_in(const json& value, const std::string& what) {
  const double number = number_in(value, what);
  if (std::abs(number) > log_common::kFarthest_m) throw std::runtime_error(what + " is beyond 100 km");
  return number;
}

double range_in(const json& value) {
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  const double number = number_in(value, "a range");
  return std::abs(number) > log_common::kFarthest_m ? std::numeric_limits<double>::infinity() : number;
}

// As many programs write them, and no JSON parser takes: infinite becomes a far number, no number a negative range.
std::string with_numbers_of_json(std::string text) {
  const auto replace_all = [&text](std::string_view name, std::string_view number) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + number.size()))
      text.replace(at, name.size(), number);
  };
  replace_all("Infinity", "1e9     ");
  replace_all("NaN", " -1");
  return text;
}

// The text up to the last scan that is whole, closed.
std::string whole_scans_of(const std::string& text, std::size_t damaged_at) {
  const std::size_t end = text.rfind('}', damaged_at == 0 ? 0 : damaged_at - 1);
  return end == std::string::npos ? "" : text.substr(0, end + 1) + "}}";
}

const json& member(const json& scan, const char* key) {
  const auto at = scan.find(key);
  if (at == scan.end()) throw std::runtime_error(std::string("no \"") + key + "\"");
  return *at;
}

// What is whole of a text that is damaged or ends early, when bad lines are skipped.
json Reader::root() {
  const std::string name = config_.file.string();
  std::string damage;
  const std::string text = with_numbers_of_json(log_common::text_of_file(config_.file, budget_, damage));
  if (!damage.empty()) scans_.bad_line({{name, 0, 0}, damage});
  std::size_t damaged_at = 0;
  try {
    return parsed(text, name, budget_);
  } catch (const json::parse_error& error) {
    damaged_at = error.byte > 0 ? error.byte - 1 : 0;
  } catch (const json::exception&) {
    throw ConfigError({name, 0, 0}, "a number in this JSON is too large");
  }
  const std::string_view before = std::string_view(text).substr(0, damaged_at);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const ConfigError fault({name, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                           static_cast<int>(before.size() - line_begin) + 1},
                          "no JSON from here on");
  if (config_.on_bad_line == log_common::BadLine::refuse) throw fault;
  try {
    json whole = parsed(whole_scans_of(text, damaged_at), name, budget_);
    scans_.bad_line(fault);
    return whole;
  } catch (const json::exception&) {
    throw fault;
  }
}

ScanLog Reader::read() {
  const json root = this->root();
  const auto map = root.find("map");
  if (!root.is_object() || map == root.end() || !map->is_object())
    throw ConfigError({config_.file.string(), 0, 0}, "expected {\"map\": {STAMP: {range, x, y, theta}, ...}}");
  std::vector<std::pair<double, json::const_iterator>> order;
  for (auto scan = map->begin(); scan != map->end(); ++scan) {
    double stamp_s = 0.0;
    if (log_common::read_number(scan.key(), stamp_s) && std::isfinite(stamp_s))
      order.emplace_back(stamp_s, scan);
    else
      scans_.bad_line(fault(scan.key(), "a stamp must be a number of seconds"));
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [stamp_s, scan] : order) {
    log_common::check_budget(budget_, config_.file.string());
    try {
      read_scan(stamp_s, *scan);
    } catch (const std::runtime_error& error) {
      scans_.bad_line(fault(scan.key(), error.what()));
    }
  }
  scans_.finish();
  return std::move(scans_);
}

void Reader::read_scan(double stamp_s, const json& scan) {
  const json& ranges = member(scan, "range");
  if (!ranges.is_array()) throw std::runtime_error("\"range\" must be a list");
  const bool has_pose = scan.contains("x") || scan.contains("y") || scan.contains("theta");
  if (has_pose)
    T_log_laser_ = Pose2{metres_in(member(scan, "x"), "x"), metres_in(member(scan, "y"), "y"),
                         wrap_angle(metres_in(member(scan, "theta"), "theta"))};
  const log_common::Fan fan = log_common::usual_fan(config_.laser, ranges.size());
  const std::size_t source = scans_.source(log_common::key_of(fan, ranges.size()), [&] {
    return log_common::readings_of(fan, ranges.size(), config_.laser, 0);
  });
  std::vector<double> values;
  for (const json& range : ranges) values.push_back(range_in(range));
  log_common::Scan kept;
  kept.stamp_s = stamp_s;
  if (T_log_laser_) scans_.set_pose(*T_log_laser_ * inverse(fan.T_robot_laser), kept);
  scans_.add_recorded(kept, source, std::move(values));
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.group("laser", &Config::laser, "the laser, of which the log says nothing");
  LogRules::describe_rules(fields);
}

ScanLog read_json_log(const Config& config, const Budget& budget) {
  return Reader(config, budget).read();
}

}  // namespace cairn::json_log
