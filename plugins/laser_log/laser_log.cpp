#include "plugins/laser_log/laser_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "plugins/common/logs/derived_sonar.hpp"
#include "plugins/common/logs/log_line.hpp"
#include "plugins/common/logs/log_text.hpp"

namespace cairn::laser_log {
namespace {

constexpr std::string_view kJson = "json_log";
constexpr std::string_view kPlayer = "player_log";
constexpr std::string_view kCarmen = "carmen_log";
constexpr std::string_view kMcap = "mcap_log";
constexpr std::string_view kMcapBegin = "\x89MCAP0";

constexpr int kLinesToJudge = 10000;

// time host robot interface index type subtype payload
bool is_of_player(const log_common::LogLine& line) {
  constexpr std::array<std::string_view, 4> kInterfaces = {"laser", "position2d", "ranger", "sonar"};
  double time_s = 0.0;
  return line.size() > 6 && log_common::read_number(line.word(0), time_s) &&
         std::ranges::find(kInterfaces, line.word(3)) != kInterfaces.end();
}

bool is_of_carmen(std::string_view kind) {
  constexpr std::array<std::string_view, 6> kBeginnings = {"FLASER",   "RLASER",        "ROBOTLASER",
                                                           "RAWLASER", "LASER_READING", "VERTEX"};
  return std::ranges::any_of(kBeginnings, [&](std::string_view begin) { return kind.starts_with(begin); });
}

// The first line that only one of them has decides. A long first line is one of JSON.
std::string_view name_of_reader(const std::filesystem::path& file, const Budget& budget) {
  log_common::LogText text(file, budget);
  log_common::LogLine line(file.string());
  std::string_view content;
  try {
    while (text.line_number() < kLinesToJudge && text.next(content)) {
      if (text.line_number() == 1 && content.starts_with(kMcapBegin)) return kMcap;
      line.cut(content, text.line_number());
      if (line.size() == 0) continue;
      if (line.word(0).front() == '{') return kJson;
      if (line.text().starts_with("## Player") || is_of_player(line)) return kPlayer;
      if (is_of_carmen(line.word(0))) return kCarmen;
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

constexpr double kResolution_m = 1e-3;
constexpr std::size_t kOneIn = 1000;
constexpr std::size_t kFewestOfACode = 10;
constexpr double kJustBelow = 0.995;  // neighbouring numbers are codes of other faults
constexpr double kFlank = 0.95;

// A far wall has ranges on both sides of its most frequent one, a code has not.
bool stands_out(const std::map<double, std::size_t>& counts, double range_m, std::size_t count) {
  constexpr std::size_t kTimes = 3;
  std::size_t below = 0;
  for (auto at = counts.lower_bound(kFlank * range_m); at != counts.end() && at->first < kJustBelow * range_m; ++at)
    below += at->second;
  return count >= kTimes * below;
}

bool is_of_a_laser(const std::vector<RangeReading>& readings) {
  constexpr double kNarrow_rad = radians(1.0);
  return std::ranges::all_of(readings,
                             [&](const RangeReading& reading) { return reading.half_beam_rad <= kNarrow_rad; });
}

std::vector<RangeReading> derived_ring(const std::vector<RangeReading>& beams, const Config& config) {
  std::vector<RangeReading> readings;
  int number = 0;
  for (const SonarModel& sonar :
       log_common::ring_for(beams, config.sonars, config.sonar_half_beam_rad, config.sonar_max_m)) {
    const int sensor = number++;
    if (const auto range_m = log_common::derived_range(sonar, beams))
      readings.push_back({sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m, *range_m, sensor});
  }
  return readings;
}

// For the report, where nobody should take them for the log's own.
std::string with_worn_wheels(std::string reason, const WornWheels& wheels) {
  if (wheels.length_ratio == 0.0 && wheels.rad_per_m == 0.0) return reason;
  return fmt::format("{}{}odometry worsened: {:.3g} % longer, {:.3g} deg per square root of a metre, seed {}", reason,
                     reason.empty() ? "" : "; ", 100.0 * wheels.length_ratio, degrees(wheels.rad_per_m), wheels.seed);
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.number("longest_m", &Config::longest_m, {0.1, 1000.0}, "m",
                "echoes from farther away say nothing: lasers write a great range for no echo");
  fields.integer("sonars", &Config::sonars, {0, 1000},
                 "each scan as so many sonars, spread over the laser's field, might have heard it: the nearest echo in "
                 "each cone; 0: the scan itself");
  fields.angle("sonar_half_beam_deg", &Config::sonar_half_beam_rad, {0.1, 90}, "half the width of such a cone");
  fields.number("sonar_max_m", &Config::sonar_max_m, {0.2, 1000.0}, "m", "longest range of such a sonar");
  fields.group("worsen", &Config::worsen, "for trials: the log's odometry made worse, as by worn wheels");
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
  std::map<double, std::size_t> counts;  // of the ranges
  std::size_t all = 0;
  while (true) {
    const SensorStep step = log.next(budget);
    if (step.state != SensorState::observation) break;
    for (const RangeReading& reading : step.observation.ranges) {
      ++all;
      if (std::isfinite(reading.range_m)) ++counts[std::round(reading.range_m / kResolution_m) * kResolution_m];
    }
  }
  const auto beyond = counts.lower_bound(longest_m);
  if (beyond == counts.begin()) return longest_m;
  const auto& [greatest_m, count] = *std::prev(beyond);
  const bool is_code = count >= kFewestOfACode && kOneIn * count >= all && stands_out(counts, greatest_m, count);
  return is_code ? kJustBelow * greatest_m : longest_m;
}

SensorStep LaserLog::next(const Budget& budget) {
  SensorStep step = source_->next(budget);
  if (step.state == SensorState::end_of_data) step.reason = with_worn_wheels(std::move(step.reason), config_.worsen);
  step.observation.T_odom_robot = odometry_.next(step.observation.T_odom_robot);
  // Nearer than a laser measures is a fault of the reading, often written as 0.
  for (RangeReading& reading : step.observation.ranges)
    if (reading.range_m > longest_m_ || reading.range_m < reading.min_m)
      reading.range_m = std::numeric_limits<double>::quiet_NaN();
  if (config_.sonars > 0 && is_of_a_laser(step.observation.ranges))
    step.observation.ranges = derived_ring(step.observation.ranges, config_);
  return step;
}

}  // namespace cairn::laser_log
