#include "plugins/ros2_robot/settings_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace cairn::ros2_robot {
namespace {

void check_topic(const char* key, const std::string& topic, bool may_be_empty) {
  if (topic.empty() && may_be_empty) return;
  if (!topic.starts_with('/') || topic.ends_with('/'))
    throw std::invalid_argument(
        fmt::format("ros2_robot: `{}` is \"{}\"; a topic is given by its full name, as /scan", key, topic));
}

}  // namespace

void check_settings(const Config& config, const RobotModel& robot) {
  check_topic("odometry", config.odometry, false);
  check_topic("command.topic", config.command.topic, false);
  check_topic("compass.topic", config.compass.topic, true);
  check_topic("battery", config.battery, true);
  check_topic("emergency", config.emergency, true);
  check_topic("static_frames", config.static_frames, true);
  check_topic("show.map", config.show.map, true);
  check_topic("show.pose", config.show.pose, true);
  check_topic("show.plan", config.show.plan, true);
  check_topic("show.landmarks", config.show.landmarks, true);
  check_topic("show.diagnostics", config.show.diagnostics, true);
  check_topic("goal", config.goal, true);
  check_topic("initial_pose.topic", config.initial_pose.topic, true);
  for (const std::string& bumper : config.bumpers) check_topic("bumpers", bumper, false);
  if (config.mounting == Mounting::frames && config.static_frames.empty())
    throw std::invalid_argument("ros2_robot: `mounting: frames` needs `static_frames`, which is empty");
  if (config.ranges.empty()) throw std::invalid_argument("ros2_robot: `ranges` names no topic: what does it see by?");
  for (const RangeTopic& range : config.ranges) {
    check_topic("ranges.topic", range.topic, false);
    const bool is_laser = range.kind == RangeKind::laser;
    const std::size_t known = is_laser ? robot.lasers.size() : robot.sonars.size();
    const std::size_t wanted = static_cast<std::size_t>(range.first) + std::max<std::size_t>(1, range.frames.size());
    if (wanted > known)
      throw std::invalid_argument(fmt::format("ros2_robot: {} is of {} {}, and the robot's file has {}", range.topic,
                                              is_laser ? "laser" : "sonar", wanted - 1, known));
  }
}

}  // namespace cairn::ros2_robot
