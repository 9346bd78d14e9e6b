#include "framework/reporting/recordings/recording.hpp"

#include <cmath>
#include <stdexcept>

#include "framework/reporting/recordings/recording_errors.hpp"
#include "framework/reporting/recordings/scan_rays.hpp"
#include "maps/base/deflate.hpp"
#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxWaitingBytes = std::size_t{1} << 16U;
constexpr double kMaxUnwritten_s = 5.0;

void append(std::string& text, std::string_view separator, std::initializer_list<double> values) {
  for (const double value : values) {
    text += separator;
    exchange::append_number(text, value);
  }
}

void append(std::string& text, std::string_view separator, const Pose2& pose) {
  append(text, separator, {pose.x_m, pose.y_m, pose.theta_rad});
}

std::string sensor_text(const RangeReading& reading) {
  std::string text = std::to_string(reading.sensor);
  append(text, ",", reading.T_robot_sensor);
  append(text, ",", {reading.half_beam_rad, reading.min_m, reading.max_m});
  return text;
}

// What every reader of CARMEN logs takes for a number, and ours for what it was: beyond max_m is no
// echo, 0 nearer than min_m, negative a bad reading.
void append_range(std::string& text, const RangeReading& reading) {
  text += ' ';
  const double beyond_m = reading.max_m + 1.0;
  if (std::isnan(reading.range_m))
    text += "-1";
  else if (std::isinf(reading.range_m) && reading.range_m > 0.0)
    exchange::append_number(text, beyond_m);
  else if (std::isinf(reading.range_m))
    text += reading.min_m > 0.0 ? "0" : "-inf";
  else
    exchange::append_number(text, reading.range_m);
}

bool is_same_transducer(const RangeReading& a, const RangeReading& b) {
  return a.T_robot_sensor == b.T_robot_sensor && a.half_beam_rad == b.half_beam_rad && a.min_m == b.min_m &&
         a.max_m == b.max_m;
}

}  // namespace

RunRecording::RunRecording(const std::filesystem::path& file, const Pose2& T_map_start)
    : file_name_(file.string()),
      is_packed_(file.extension() == ".gz"),
      out_(in_recording(file_name_, [&] { return GrowingFile(file); })) {
  text_ =
      "# CARMEN log, written by cairn\n"
      "# message formats: PARAM ODOM TRUEPOS SONAR ROBOTLASER1; what the PARAM cairn_ lines say: docs/logs.md\n"
      "PARAM cairn_start ";
  exchange::append_number(text_, T_map_start.x_m);
  append(text_, ",", {T_map_start.y_m, T_map_start.theta_rad});
  text_ += " 0 cairn 0\n";
}

void RunRecording::on(const Event& event, const MissionView& view) {
  if (!std::holds_alternative<TickDone>(event) || view.world.observation == nullptr) return;
  write(*view.world.observation, view.truth);
  const double stamp_s = view.world.observation->stamp_s;
  if (text_.size() < kMaxWaitingBytes && std::abs(stamp_s - written_s_) < kMaxUnwritten_s) return;
  written_s_ = stamp_s;
  write_text();
}

void RunRecording::close() {
  write_text();
  in_recording(file_name_, [&] { out_.close(); });
}

void RunRecording::write(const Observation& observation, const std::optional<GroundTruth>& truth) {
  std::string end;
  append(end, " ", {observation.stamp_s});
  end += " cairn";
  append(end, " ", {observation.stamp_s});
  end += '\n';

  write_new_sensors(observation, end);
  text_ += "ODOM";
  append(text_, " ", observation.T_odom_robot);
  text_ += " 0 0 0" + end;
  if (truth) {
    text_ += "TRUEPOS";
    append(text_, " ", truth->T_map_robot);
    append(text_, " ", observation.T_odom_robot);
    text_ += end;
  }
  text_ += observation.bumped ? "PARAM cairn_observation 1," : "PARAM cairn_observation 0,";
  if (observation.compass_rad)
    exchange::append_number(text_, *observation.compass_rad);
  else
    text_ += "none";
  for (std::size_t i = 0; i < fired_.size(); ++i) {
    const std::size_t first = i;
    while (i + 1 < fired_.size() && fired_[i + 1] == fired_[i] + 1) ++i;
    text_ += "," + std::to_string(fired_[first]);
    if (i > first) text_ += "-" + std::to_string(fired_[i]);
  }
  text_ += end;
  write_ranges(observation, end);
}

void RunRecording::write_new_sensors(const Observation& observation, std::string_view end) {
  fired_.clear();
  for (const RangeReading& reading : observation.ranges) fired_.push_back(number_of(reading, end));
}

int RunRecording::number_of(const RangeReading& reading, std::string_view end) {
  const auto known = last_numbers_.find(reading.sensor);
  if (known != last_numbers_.end() && is_same_transducer(known->second.first, reading)) return known->second.second;
  const int next = static_cast<int>(numbers_.size());
  const auto [at, is_new] = numbers_.try_emplace(sensor_text(reading), next);
  if (is_new) text_.append("PARAM cairn_sensor_" + std::to_string(next) + " " + at->first).append(end);
  last_numbers_.insert_or_assign(reading.sensor, std::pair(reading, at->second));
  return at->second;
}

// One line for all that follow each other with the same cone, or in one scan.
void RunRecording::write_ranges(const Observation& observation, std::string_view end) {
  const std::span<const RangeReading> ranges(observation.ranges);
  for (std::size_t first = 0, last = 0; first < ranges.size(); first = last) {
    last = first + rays_of_a_scan(ranges.subspan(first));
    if (last - first > 1) {
      write_scan(ranges.subspan(first, last - first), observation.T_odom_robot, end);
      continue;
    }
    last = first;
    while (last < ranges.size() && ranges[last].half_beam_rad == ranges[first].half_beam_rad &&
           rays_of_a_scan(ranges.subspan(last)) < 2)
      ++last;
    if (last == first) ++last;  // a cone that is not a number
    write_sonars(ranges.subspan(first, last - first), end);
  }
}

void RunRecording::write_sonars(std::span<const RangeReading> ranges, std::string_view end) {
  text_ += "SONAR";
  append(text_, " ", {2.0 * ranges.front().half_beam_rad});
  text_ += " " + std::to_string(ranges.size());
  for (const RangeReading& reading : ranges) append_range(text_, reading);
  for (const RangeReading& reading : ranges) append(text_, " ", reading.T_robot_sensor);
  text_ += end;
}

// ROBOTLASER1 type first_angle field step max_range accuracy remission_mode n r1..rn 0 (laser) (robot) 5 numbers
void RunRecording::write_scan(std::span<const RangeReading> rays, const Pose2& T_odom_robot, std::string_view end) {
  const Pose2& T_robot_first = rays.front().T_robot_sensor;
  const double step_rad = wrap_angle(rays[1].T_robot_sensor.theta_rad - T_robot_first.theta_rad);
  const Pose2 T_robot_laser{T_robot_first.x_m, T_robot_first.y_m, 0.0};
  text_ += "ROBOTLASER1 0";
  append(text_, " ", {T_robot_first.theta_rad, step_rad * static_cast<double>(rays.size() - 1), step_rad});
  append(text_, " ", {rays.front().max_m});
  text_ += " 0 0 " + std::to_string(rays.size());
  for (const RangeReading& ray : rays) append_range(text_, ray);
  text_ += " 0";
  append(text_, " ", T_odom_robot * T_robot_laser);
  append(text_, " ", T_odom_robot);
  text_ += " 0 0 0 0 0";
  text_ += end;
}

void RunRecording::write_text() {
  const std::string text = std::exchange(text_, {});  // what fails is not written a second time
  if (text.empty()) return;
  in_recording(file_name_, [&] {
    out_.append(is_packed_ ? gzip_member(text) : text);
    out_.flush();
  });
}

}  // namespace cairn
