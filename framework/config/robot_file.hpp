// config/robots/*.yaml -> RobotModel. Throws ConfigError.
#pragma once

#include <filesystem>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

[[nodiscard]] RobotModel load_robot(const std::filesystem::path& file);

}  // namespace cairn
