#include "plugins/ros2_robot/range_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/live/steady_time.hpp"
#include "maps/base/spelling.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kMaxReadingAge_s = 1.0;
constexpr double kMaxReadingAhead_s = 0.3;  // of the odometry; it waits for the next
constexpr std::size_t kMaxHeard = 20000;

const dds_topic_descriptor_t& type_of(RangeKind kind) {
  switch (kind) {
    case RangeKind::range:
      return sensor_msgs_msg_dds__Range__desc;
    case RangeKind::laser:
      return sensor_msgs_msg_dds__LaserScan__desc;
    case RangeKind::point_cloud:
      return sensor_msgs_msg_dds__PointCloud__desc;
    case RangeKind::point_cloud2:
      break;
  }
  return sensor_msgs_msg_dds__PointCloud2__desc;
}

}  // namespace

double stamp_s(const Config& config, const Header& header, double arrived_s) {
  return config.stamp == Stamp::header ? seconds_of(header.stamp) : arrived_s;
}

void RangeTopics::open(const Participant& participant) {
  for (const RangeTopic& range : config_.ranges)
    readers_.push_back({&range, participant.reader(range.topic, type_of(range.kind))});
}

void RangeTopics::take(SensorPlaces& places) {
  for (const RangeReader& from : readers_) take_from(from, places);
}

std::vector<RangeReading> RangeTopics::seen_from(double stamp_s, const Pose2& T_odom_robot, const PoseHistory& poses) {
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

int RangeTopics::sonar_of(const RangeTopic& topic, const std::string& frame) const {
  if (topic.frames.empty()) return topic.first;
  const auto found = std::ranges::find(topic.frames, frame);
  if (found == topic.frames.end())
    throw std::runtime_error(fmt::format("{} has the frame \"{}\", and `frames` does not{}", topic.topic, frame,
                                         did_you_mean(frame, topic.frames)));
  return topic.first + static_cast<int>(found - topic.frames.begin());
}

void RangeTopics::take_from(const RangeReader& from, SensorPlaces& places) {
  const double arrived_s = live::now_s();
  const RangeTopic& topic = *from.topic;
  const dds_entity_t reader = from.reader.get();
  const auto take_cloud = [&](const auto& cloud) {
    try {
      take_points(topic, cloud.header, points_of(cloud), arrived_s, places);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(topic.topic + ": " + error.what());
    }
  };
  if (topic.kind == RangeKind::range)
    take_all<Range>(reader, [&](const Range& range) { take_range(topic, range, arrived_s, places); });
  else if (topic.kind == RangeKind::laser)
    take_all<LaserScan>(reader, [&](const LaserScan& scan) { take_scan(topic, scan, arrived_s, places); });
  else if (topic.kind == RangeKind::point_cloud)
    take_all<PointCloud>(reader, take_cloud);
  else
    take_all<PointCloud2>(reader, take_cloud);
  if (heard_.size() > kMaxHeard) heard_.erase(heard_.begin(), heard_.end() - kMaxHeard);
}

void RangeTopics::take_range(const RangeTopic& topic, const Range& range, double arrived_s, SensorPlaces& places) {
  const int number = sonar_of(topic, range.header.frame_id);
  SonarModel sonar = robot_.sonars[static_cast<std::size_t>(number)];
  const auto place = places.of_sensor(range.header.frame_id, sonar.T_robot_sonar, arrived_s);
  if (!place) return;
  sonar.T_robot_sonar = place->T_base_sensor;
  heard_.push_back(
      {stamp_s(config_, range.header, arrived_s), reading_of(range, sonar, number, config_.no_echo_from_m)});
}

void RangeTopics::take_scan(const RangeTopic& topic, const LaserScan& scan, double arrived_s, SensorPlaces& places) {
  const auto number = static_cast<std::size_t>(topic.first);
  LaserModel laser = robot_.lasers[number];
  const auto place = places.of_sensor(scan.header.frame_id, laser.T_robot_laser, arrived_s);
  if (!place) return;
  laser.T_robot_laser = place->T_base_sensor;
  for (const RangeReading& reading :
       readings_of(scan, laser, first_beam_of(robot_, number), config_.no_echo_from_m, place->is_upside_down))
    heard_.push_back({stamp_s(config_, scan.header, arrived_s), reading});
}

void RangeTopics::take_points(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m,
                              double arrived_s, SensorPlaces& places) {
  const std::size_t known = robot_.sonars.size() - static_cast<std::size_t>(topic.first);
  if (points_m.size() > known)
    throw std::runtime_error(fmt::format("has {} points, and the robot's file {} sonars from number {} on",
                                         points_m.size(), known, topic.first));
  const auto place = places.of_frame(header.frame_id, arrived_s);
  if (!place) return;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const int number = topic.first + static_cast<int>(i);
    const Point seen_m(points_m[i].x(), place->is_upside_down ? -points_m[i].y() : points_m[i].y());
    heard_.push_back({stamp_s(config_, header, arrived_s),
                      reading_of(place->T_base_sensor * seen_m, robot_.sonars[static_cast<std::size_t>(number)], number,
                                 config_.no_echo_from_m)});
  }
}

}  // namespace cairn::ros2_robot
