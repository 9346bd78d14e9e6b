// config/templates/*.yaml -> LandmarkShape. Throws ConfigError.
#pragma once

#include <filesystem>
#include <vector>

#include "maps/contour.hpp"

namespace cairn {

struct Schema;

[[nodiscard]] LandmarkShape load_landmark_shape(const std::filesystem::path& file);
// Every *.yaml of a folder, sorted by category. Refuses an empty folder and a category named twice.
[[nodiscard]] std::vector<LandmarkShape> load_landmark_shapes(const std::filesystem::path& folder);
// What such a file may hold, for the reference and the JSON schema.
[[nodiscard]] Schema template_file_schema();

}  // namespace cairn
