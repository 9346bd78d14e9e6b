// config/robots/*.yaml -> RobotModel. Throws ConfigError.
#pragma once

#include <filesystem>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

struct Schema;

[[nodiscard]] RobotModel load_robot(const std::filesystem::path& file);
// What such a file may hold, for the reference and the JSON schema.
[[nodiscard]] Schema robot_file_schema();

}  // namespace cairn
