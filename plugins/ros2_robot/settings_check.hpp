// Settings that cannot be, before a network is touched.
#pragma once

#include "framework/contracts/robot_model.hpp"
#include "plugins/ros2_robot/config.hpp"

namespace cairn::ros2_robot {

// Throws std::invalid_argument with the setting, and what it should be.
void check_settings(const Config& config, const RobotModel& robot);

}  // namespace cairn::ros2_robot
