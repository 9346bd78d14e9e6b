#include "plugins/carmen_log/recording.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "maps/base/text.hpp"
#include "plugins/common/logs/range_rule.hpp"

namespace cairn::carmen_log {
namespace {

using log_common::LogLine;

constexpr int kMaxSensors = 1000000;
constexpr std::size_t kValue = 2;  // PARAM name value
constexpr std::string_view kSensor = "cairn_sensor_";

// The text up to the next comma, which goes too.
std::string_view next_item(std::string_view& rest) {
  const std::size_t end = std::min(rest.find(','), rest.size());
  const std::string_view item = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return item;
}

template <std::size_t kCount>
std::array<double, kCount> numbers_in(std::string_view text, const SourcePlace& place) {
  std::array<double, kCount> numbers{};
  for (double& number : numbers)
    if (!log_common::read_number(next_item(text), number) || std::abs(number) > 1e9 || std::isnan(number))
      throw ConfigError(place, "expected " + std::to_string(kCount) + " numbers with commas between them");
  if (!text.empty()) throw ConfigError(place, "more than " + std::to_string(kCount) + " numbers");
  return numbers;
}

int whole_number(std::string_view text, const SourcePlace& place) {
  const auto number = number_from<int>(text);
  if (!number || *number < 0 || *number >= kMaxSensors)
    throw ConfigError(place, "the number of a sensor must be whole and less than 1000000, not " + in_quotes(text));
  return *number;
}

RangeReading sensor_in(std::string_view text, const SourcePlace& place) {
  const auto n = numbers_in<7>(text, place);
  const RangeReading reading{{n[1], n[2], n[3]}, n[4], n[5], n[6], 0.0, static_cast<int>(n[0])};
  if (reading.half_beam_rad < 0.0 || reading.half_beam_rad > std::numbers::pi || reading.min_m < 0.0 ||
      reading.min_m >= reading.max_m || n[0] < 0.0)
    throw ConfigError(place, "not the values of a sensor: sensor,x,y,theta,half_beam,min,max");
  return reading;
}

}  // namespace

void Recording::read_param(const LogLine& line) {
  if (line.size() <= kValue) throw ConfigError(line.place(kValue), "the line ends where the value must be");
  const std::string_view name = line.word(1);
  if (name == "cairn_observation") return begin_observation(line);
  if (name == "cairn_start") {
    const auto n = numbers_in<3>(line.word(kValue), line.place(kValue));
    scans_.set_start({n[0], n[1], n[2]});
  } else if (name.starts_with(kSensor)) {
    const int key = whole_number(name.substr(kSensor.size()), line.place(1));
    sensors_.insert_or_assign(key, sensor_in(line.word(kValue), line.place(kValue)));
  }
}

void Recording::read_odometry(const LogLine& line) {
  // As it stands: wrapped, an angle might come out another.
  T_odom_robot_ = {line.metres(1, "x"), line.metres(2, "y"), line.heading(3)};
}

void Recording::begin_observation(const LogLine& line) {
  check_complete(line.place(0));
  const SourcePlace place = line.place(kValue);
  std::string_view sensors = line.word(kValue);
  log_common::Scan scan;
  scan.line = line.line();
  scan.stamp_s = line.finite(kValue + 1, "time");
  scan.bumped = next_item(sensors) == "1";
  const std::string_view compass = next_item(sensors);
  if (compass != "none") {
    scan.compass_rad = 0.0;
    if (!log_common::read_number(compass, *scan.compass_rad) || !std::isfinite(*scan.compass_rad))
      throw ConfigError(place, "the compass must be a number or \"none\", not " + in_quotes(compass));
  }
  scan.T_odom_robot = T_odom_robot_;
  scan.true_T_map_robot = truth_;
  source_ = scans_.source("recorded " + std::string(sensors), [&] { return readings_of(sensors, place); });
  waiting_ = scan;
  ranges_m_.clear();
  complete();
}

std::vector<RangeReading> Recording::readings_of(std::string_view sensors, const SourcePlace& place) const {
  std::vector<RangeReading> readings;
  while (!sensors.empty()) {
    const std::string_view item = next_item(sensors);
    const std::size_t dash = std::min(item.find('-'), item.size());
    const int first = whole_number(item.substr(0, dash), place);
    const int last = dash < item.size() ? whole_number(item.substr(dash + 1), place) : first;
    for (int key = first; key <= last; ++key) {
      const auto sensor = sensors_.find(key);
      if (sensor == sensors_.end())
        throw ConfigError(place, "no PARAM cairn_sensor_" + std::to_string(key) + " so far");
      if (readings.size() == static_cast<std::size_t>(kMaxSensors)) throw ConfigError(place, "too many sensors");
      readings.push_back(sensor->second);
    }
  }
  return readings;
}

bool Recording::take_ranges(const LogLine& line, std::size_t count_at) {
  if (!waiting_) return false;
  const std::vector<RangeReading>& readings = scans_.readings_of(source_);
  const std::size_t count = line.count(count_at, "count of ranges");
  if (ranges_m_.size() + count > readings.size())
    throw ConfigError(line.place(count_at), "more ranges than the observation has sensors");
  for (std::size_t i = 0; i < count; ++i) {
    const RangeReading& reading = readings[ranges_m_.size()];
    ranges_m_.push_back(log_common::range_from(line.range_m(count_at + 1 + i), 1.0, {}, reading.min_m, reading.max_m));
  }
  complete();
  return true;
}

void Recording::complete() {
  if (ranges_m_.size() < scans_.readings_of(source_).size()) return;
  scans_.add(*waiting_, source_, ranges_m_);
  waiting_.reset();
}

void Recording::check_complete(const SourcePlace& place) {
  if (!waiting_) return;
  const std::string sentence = "the recorded observation before has " + std::to_string(ranges_m_.size()) + " of " +
                               std::to_string(scans_.readings_of(source_).size()) + " ranges";
  waiting_.reset();
  scans_.bad_line(ConfigError(place, sentence));
}

}  // namespace cairn::carmen_log
