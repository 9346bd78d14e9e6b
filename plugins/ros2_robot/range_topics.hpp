// The topics that ranges come by, of all kinds.
#pragma once

#include <vector>

#include "plugins/common/ros/robot_observer.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

class RangeTopics {
 public:
  // It must outlive it.
  explicit RangeTopics(const Config& config) : config_(config) {}

  void open(const Participant& participant);
  // What has come. Throws std::runtime_error with the topic and what about it cannot be.
  void take(ros::RobotObserver& observer) const;
  // In the order of the settings.
  [[nodiscard]] const std::vector<Entity>& readers() const { return readers_; }

 private:
  const Config& config_;
  std::vector<Entity> readers_;
};

}  // namespace cairn::ros2_robot
