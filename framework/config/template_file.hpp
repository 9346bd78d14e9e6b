// config/templates/*.yaml -> LandmarkShape. Throws ConfigError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "maps/contour.hpp"

namespace cairn {

struct Schema;

[[nodiscard]] LandmarkShape load_landmark_shape(const std::filesystem::path& file);
// More categories in one folder are refused: their templates would be rendered for minutes.
inline constexpr std::size_t kMostTemplateFiles = 500;
struct TemplateFile {
  std::filesystem::path file;
  std::string outline;  // how it is given: "circle", "polygon", "parts" or "picture"
  LandmarkShape shape;
};
// Every *.yaml of a folder, sorted by category. Refuses an empty folder, one of more than
// kMostTemplateFiles and a category named twice.
[[nodiscard]] std::vector<TemplateFile> load_template_files(const std::filesystem::path& folder);
[[nodiscard]] std::vector<LandmarkShape> load_landmark_shapes(const std::filesystem::path& folder);  // the same
// What such a file may hold, for the reference and the JSON schema.
[[nodiscard]] Schema template_file_schema();

}  // namespace cairn
