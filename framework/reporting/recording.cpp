#include "framework/reporting/recording.hpp"

#include <cmath>
#include <stdexcept>

#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

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

template <class Work>
auto in_recording(const std::string& file_name, const Work& work) {
  try {
    return work();
  } catch (const OutputError& error) {
    throw std::runtime_error(file_name + ": the recording " + error.what());
  }
}

}  // namespace

RunRecording::RunRecording(const std::filesystem::path& file, const Pose2& T_map_start)
    : file_name_(file.string()), out_(in_recording(file_name_, [&] { return GrowingFile(file); })) {
  text_ =
      "# CARMEN log, written by cairn\n"
      "# message formats: PARAM ODOM TRUEPOS SONAR; what the PARAM cairn_ lines say: docs/logs.md\n"
      "PARAM cairn_start ";
  exchange::append_number(text_, T_map_start.x_m);
  append(text_, ",", {T_map_start.y_m, T_map_start.theta_rad});
  text_ += " 0 cairn 0\n";
  flush_text();
}

void RunRecording::on(const Event& event, const MissionView& view) {
  if (std::holds_alternative<TickDone>(event) && view.world.observation != nullptr)
    write(*view.world.observation, view.truth);
}

void RunRecording::close() {
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
  write_sonars(observation, end);
  flush_text();
}

void RunRecording::write_new_sensors(const Observation& observation, std::string_view end) {
  fired_.clear();
  for (const RangeReading& reading : observation.ranges) {
    std::string values = sensor_text(reading);
    const int next = static_cast<int>(numbers_.size());
    const auto [at, is_new] = numbers_.try_emplace(std::move(values), next);
    if (is_new) text_.append("PARAM cairn_sensor_" + std::to_string(next) + " " + at->first).append(end);
    fired_.push_back(at->second);
  }
}

// One line for all that follow each other with the same cone.
void RunRecording::write_sonars(const Observation& observation, std::string_view end) {
  const auto& ranges = observation.ranges;
  for (std::size_t first = 0, last = 0; first < ranges.size(); first = last) {
    while (last < ranges.size() && ranges[last].half_beam_rad == ranges[first].half_beam_rad) ++last;
    if (last == first) ++last;  // a cone that is not a number
    text_ += "SONAR";
    append(text_, " ", {2.0 * ranges[first].half_beam_rad});
    text_ += " " + std::to_string(last - first);
    for (std::size_t i = first; i < last; ++i) append_range(text_, ranges[i]);
    for (std::size_t i = first; i < last; ++i) append(text_, " ", ranges[i].T_robot_sensor);
    text_ += end;
  }
}

void RunRecording::flush_text() {
  in_recording(file_name_, [&] { out_.append(text_); });
  text_.clear();
}

}  // namespace cairn
