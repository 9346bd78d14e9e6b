// Which network the robot is on: by the mission's settings, and by ROS 2's variables of the environment for those that
// the mission leaves open.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

// The value of a variable; empty where it is not set, which ROS 2 takes for the same.
using Environment = std::function<std::string(const char* name)>;
[[nodiscard]] std::string process_environment(const char* name);

struct ChosenNetwork {
  NetworkChoice network;
  std::vector<std::string> variables;  // that had a say, as "ROS_DOMAIN_ID=7"
};

// ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS. As in ROS 2, ROS_LOCALHOST_ONLY=1
// silences the last two, and SYSTEM_DEFAULT the last one. OFF is refused: nobody would be met. Throws
// std::invalid_argument with the variable, its value and what is allowed.
[[nodiscard]] ChosenNetwork choose_network(const Config& config, const Environment& environment = process_environment);

}  // namespace cairn::ros2_robot
