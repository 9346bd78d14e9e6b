// The robot that a saved map was made with, as far as routes need it.
#pragma once

#include <filesystem>

#include "maps/store/map_store.hpp"

namespace cairn {

inline constexpr const char* kRobotRadiusProperty = "robot_radius_m";  // of maps that a mission has saved

// The saved property robot_radius_m, or the radius of the robot model when there is none. file: for the error.
// Throws StoreError when it is not a radius.
[[nodiscard]] double saved_radius_m(const SavedMap& map, const std::filesystem::path& file);

}  // namespace cairn
