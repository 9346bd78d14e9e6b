#include "plugins/common/ros/range_buffer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "maps/base/spelling.hpp"

namespace cairn::ros {
namespace {

constexpr double kMaxReadingAge_s = 1.0;
constexpr double kMaxReadingAhead_s = 0.3;  // of the odometry; it waits for the next
constexpr std::size_t kMaxHeard = 20000;

}  // namespace

double stamp_s(const RobotTopics& topics, const Header& header, double arrived_s) {
  return topics.stamp == Stamp::header ? header.stamp_s : arrived_s;
}

std::vector<RangeReading> RangeBuffer::seen_from(double stamp_s, const Pose2& T_odom_robot, const PoseHistory& poses) {
  std::vector<RangeReading> seen;
  std::vector<HeardRange> ahead;
  for (HeardRange& heard : heard_) {
    const double age_s = stamp_s - heard.stamp_s;
    if (age_s < 0.0 && age_s >= -kMaxReadingAhead_s) ahead.push_back(heard);
    if (age_s < 0.0 || age_s > kMaxReadingAge_s) continue;
    const Pose2 T_now_then = inverse(T_odom_robot) * poses.at(heard.stamp_s).value_or(T_odom_robot);
    heard.reading.T_robot_sensor = T_now_then * heard.reading.T_robot_sensor;
    seen.push_back(heard.reading);
  }
  heard_ = std::move(ahead);
  return seen;
}

int RangeBuffer::sonar_of(const RangeTopic& topic, const std::string& frame) const {
  if (topic.frames.empty()) return topic.first;
  const auto found = std::ranges::find(topic.frames, frame);
  if (found == topic.frames.end())
    throw std::runtime_error(fmt::format("{} has the frame \"{}\", and `frames` does not{}", topic.topic, frame,
                                         did_you_mean(frame, topic.frames)));
  return topic.first + static_cast<int>(found - topic.frames.begin());
}

void RangeBuffer::add(const RangeTopic& topic, const Range& range, double arrived_s, SensorPlaces& places) {
  const int number = sonar_of(topic, range.header.frame);
  SonarModel sonar = robot_.sonars[static_cast<std::size_t>(number)];
  const auto place = places.of_sensor(range.header.frame, sonar.T_robot_sonar, arrived_s);
  if (!place) return;
  sonar.T_robot_sonar = place->T_base_sensor;
  heard_.push_back(
      {stamp_s(topics_, range.header, arrived_s), reading_of(range, sonar, number, topics_.no_echo_from_m)});
  keep_room();
}

void RangeBuffer::add(const RangeTopic& topic, const Scan& scan, double arrived_s, SensorPlaces& places) {
  const auto number = static_cast<std::size_t>(topic.first);
  LaserModel laser = robot_.lasers[number];
  const auto place = places.of_sensor(scan.header.frame, laser.T_robot_laser, arrived_s);
  if (!place) return;
  laser.T_robot_laser = place->T_base_sensor;
  for (const RangeReading& reading :
       readings_of(scan, laser, first_beam_of(robot_, number), topics_.no_echo_from_m, place->is_upside_down))
    heard_.push_back({stamp_s(topics_, scan.header, arrived_s), reading});
  keep_room();
}

void RangeBuffer::add(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m,
                      double arrived_s, SensorPlaces& places) {
  const std::size_t known = robot_.sonars.size() - static_cast<std::size_t>(topic.first);
  if (points_m.size() > known)
    throw std::runtime_error(fmt::format("{}: has {} points, and the robot's file {} sonars from number {} on",
                                         topic.topic, points_m.size(), known, topic.first));
  const auto place = places.of_frame(header.frame, arrived_s);
  if (!place) return;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const int number = topic.first + static_cast<int>(i);
    const Point seen_m(points_m[i].x(), place->is_upside_down ? -points_m[i].y() : points_m[i].y());
    heard_.push_back({stamp_s(topics_, header, arrived_s),
                      reading_of(place->T_base_sensor * seen_m, robot_.sonars[static_cast<std::size_t>(number)], number,
                                 topics_.no_echo_from_m)});
  }
  keep_room();
}

void RangeBuffer::keep_room() {
  if (heard_.size() > kMaxHeard) heard_.erase(heard_.begin(), heard_.end() - kMaxHeard);
}

}  // namespace cairn::ros
