// A robot on a ROS 2 network, without ROS on this computer (docs/your-robot.md). Plugin `ros2_robot`, kind sensor.
#pragma once

#include <filesystem>
#include <memory>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/base_link.hpp"
#include "plugins/ros2_robot/config.hpp"

namespace cairn::ros2_robot {

// Throws std::invalid_argument with a setting that cannot be. The budget is of waiting for a pose to begin at; guard is
// the program that stops the wheels when this process cannot (guard.hpp); empty: none does.
// wants_images: without it no topic of pictures is subscribed to.
[[nodiscard]] std::unique_ptr<live::BaseLink> link_to(const Config& config, const RobotModel& robot,
                                                      const Budget& budget = {},
                                                      const std::filesystem::path& guard = {},
                                                      bool wants_images = false);

}  // namespace cairn::ros2_robot
