// config/worlds/*.yaml -> World. Throws ConfigError.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/contracts/world.hpp"

namespace cairn {

struct Schema;

// Objects with `template: CATEGORY` take their contour from the shapes.
[[nodiscard]] World load_world(const std::filesystem::path& file, const std::vector<LandmarkShape>& shapes);
// What such a file may hold, for the reference and the JSON schema.
[[nodiscard]] Schema world_file_schema();

}  // namespace cairn
