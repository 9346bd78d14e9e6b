// config/worlds/*.yaml -> World. Throws ConfigError.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/contracts/world.hpp"

namespace cairn {

// Objects with `template: CATEGORY` take their contour from the shapes.
[[nodiscard]] World load_world(const std::filesystem::path& file, const std::vector<LandmarkShape>& shapes);

}  // namespace cairn
