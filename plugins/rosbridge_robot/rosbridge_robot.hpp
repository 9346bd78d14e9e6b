// A robot behind a rosbridge_server: ROS 1 or 2, by JSON over a WebSocket (docs/your-robot.md). Plugin
// `rosbridge_robot`, kind sensor.
#pragma once

#include <memory>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/base_link.hpp"
#include "plugins/rosbridge_robot/config.hpp"

namespace cairn::rosbridge_robot {

// Throws std::invalid_argument with a setting that cannot be.
[[nodiscard]] std::unique_ptr<live::BaseLink> link_to(const Config& config, const RobotModel& robot);

}  // namespace cairn::rosbridge_robot
