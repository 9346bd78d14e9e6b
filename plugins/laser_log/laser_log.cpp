#include "plugins/laser_log/laser_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/base/text.hpp"
#include "plugins/common/logs/log_text.hpp"

namespace cairn::laser_log {
namespace {

constexpr std::string_view kJson = "json_log";
constexpr std::string_view kPlayer = "player_log";
constexpr std::string_view kCarmen = "carmen_log";

// A long first line is one of JSON.
std::string_view name_of_reader(const std::filesystem::path& file, const Budget& budget) {
  log_common::LogText text(file, budget);
  std::string_view line;
  try {
    while (text.next(line)) {
      const std::string_view content = trimmed(line);
      if (content.empty()) continue;
      if (content.front() == '{') return kJson;
      return content.starts_with("## Player") ? kPlayer : kCarmen;
    }
  } catch (const log_common::ReadingEnded&) {
    throw;
  } catch (const ConfigError&) {
    return text.line_number() <= 1 ? kJson : kCarmen;  // the reader says what is wrong with it
  }
  return kCarmen;
}

void set(ConfigValue& map, const std::string& key, const std::string& value) {
  ConfigValue::Entry entry{key, map.place, {}};
  entry.value.kind = ConfigValue::Kind::scalar;
  entry.value.place = map.place;
  entry.value.scalar = value;
  map.entries.push_back(std::move(entry));
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.number("longest_m", &Config::longest_m, {0.1, 1000.0}, "m",
                "echoes from farther away say nothing: lasers write a great range for no echo");
}

PluginChoice reader_of(const std::filesystem::path& file, const Budget& budget) {
  const std::string_view name = name_of_reader(file, budget);
  PluginChoice choice{std::string(name), {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place.file = file.string();
  set(choice.config, "file", std::filesystem::absolute(file).string());
  set(choice.config, "no_echo_means", "nothing");
  set(choice.config, "on_bad_line", "skip");
  if (name == kCarmen) set(choice.config, "poses", "odometry");
  return choice;
}

double longest_echo_m(Sensor& log, double longest_m, const Budget& budget) {
  constexpr std::size_t kOneIn = 1000;
  constexpr std::size_t kFewest = 10;
  constexpr double kJustBelow = 0.995;  // neighbouring numbers are codes of other faults
  double greatest_m = 0.0;
  std::size_t greatest = 0;
  std::size_t all = 0;
  while (true) {
    const SensorStep step = log.next(budget);
    if (step.state != SensorState::observation) break;
    for (const RangeReading& reading : step.observation.ranges) {
      ++all;
      if (!std::isfinite(reading.range_m) || reading.range_m < greatest_m) continue;
      greatest = reading.range_m > greatest_m ? 1 : greatest + 1;
      greatest_m = reading.range_m;
    }
  }
  const bool is_no_echo = greatest >= kFewest && kOneIn * greatest >= all;
  return is_no_echo ? std::min(longest_m, kJustBelow * greatest_m) : longest_m;
}

SensorStep LaserLog::next(const Budget& budget) {
  SensorStep step = source_->next(budget);
  for (RangeReading& reading : step.observation.ranges)
    if (reading.range_m > longest_m_) reading.range_m = std::numeric_limits<double>::quiet_NaN();
  return step;
}

}  // namespace cairn::laser_log
