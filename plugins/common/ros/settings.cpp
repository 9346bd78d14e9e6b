#include "plugins/common/ros/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace cairn::ros {

void RangeTopic::describe(Fields<RangeTopic>& fields) {
  fields.text("topic", &RangeTopic::topic, "its full name, as /sonar or /robot1/scan");
  fields.choice("type", &RangeTopic::kind,
                {{"range", RangeKind::range},
                 {"laser", RangeKind::laser},
                 {"pointcloud", RangeKind::point_cloud},
                 {"pointcloud2", RangeKind::point_cloud2}},
                "sensor_msgs/Range, LaserScan, PointCloud or PointCloud2; a cloud has a point a sonar, in the order of "
                "the robot's file");
  fields.texts("frames", &RangeTopic::frames,
               "of a topic with several sonars: the frame_id of each, in the order of the robot's file");
  fields.integer("first", &RangeTopic::first, {0, 4095},
                 "number in the robot's file of its first sonar, or of its laser");
}

void CompassTopic::describe(Fields<CompassTopic>& fields) {
  fields.text("topic", &CompassTopic::topic, "what is believed as a compass; empty: none");
  fields.choice("type", &CompassTopic::kind, {{"imu", CompassKind::imu}, {"magnetic", CompassKind::magnetic_field}},
                "the orientation of a sensor_msgs/Imu, or a sensor_msgs/MagneticField of a level robot");
  fields.angle("offset_deg", &CompassTopic::offset_rad, {-360.0, 360.0}, "heading in the map when it says 0");
}

void check_topic(const char* module, const char* key, const std::string& topic, bool may_be_empty) {
  if (topic.empty() && may_be_empty) return;
  if (!topic.starts_with('/') || topic.ends_with('/'))
    throw std::invalid_argument(
        fmt::format("{}: `{}` is \"{}\"; a topic is given by its full name, as /scan", module, key, topic));
}

void check_topics(const char* module, const RobotTopics& topics, const RobotModel& robot) {
  check_topic(module, "odometry", topics.odometry, false);
  check_topic(module, "compass.topic", topics.compass.topic, true);
  check_topic(module, "battery", topics.battery, true);
  check_topic(module, "emergency", topics.emergency, true);
  check_topic(module, "static_frames", topics.static_frames, true);
  for (const std::string& bumper : topics.bumpers) check_topic(module, "bumpers", bumper, false);
  if (topics.mounting == Mounting::frames && topics.static_frames.empty())
    throw std::invalid_argument(fmt::format("{}: `mounting: frames` needs `static_frames`, which is empty", module));
  if (topics.ranges.empty())
    throw std::invalid_argument(fmt::format("{}: `ranges` names no topic: what does it see by?", module));
  for (const RangeTopic& range : topics.ranges) {
    check_topic(module, "ranges.topic", range.topic, false);
    const bool is_laser = range.kind == RangeKind::laser;
    const std::size_t known = is_laser ? robot.lasers.size() : robot.sonars.size();
    const std::size_t wanted = static_cast<std::size_t>(range.first) + std::max<std::size_t>(1, range.frames.size());
    if (wanted > known)
      throw std::invalid_argument(fmt::format("{}: {} is of {} {}, and the robot's file has {}", module, range.topic,
                                              is_laser ? "laser" : "sonar", wanted - 1, known));
  }
}

}  // namespace cairn::ros
