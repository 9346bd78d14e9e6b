// config/templates/*.yaml -> LandmarkShape. Throws ConfigError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "maps/geometry/contour.hpp"
#include "maps/landmarks/captured_outline.hpp"

namespace cairn {

struct Schema;
struct SourcePlace;

[[nodiscard]] LandmarkShape load_landmark_shape(const std::filesystem::path& file);
// The same of a text; file_name stands in the places.
[[nodiscard]] LandmarkShape parse_landmark_shape(const std::string& text, const std::string& file_name);
// More categories in one folder are refused: their templates would be rendered for minutes.
inline constexpr std::size_t kMaxTemplateFiles = 500;
struct TemplateFile {
  std::filesystem::path file;
  std::string outline;  // how it is given: "circle", "polygon", "parts" or "picture"
  LandmarkShape shape;
};
// Every *.yaml of a folder, sorted by category. Refuses an empty folder, one of more than
// kMaxTemplateFiles and a category named twice.
[[nodiscard]] std::vector<TemplateFile> load_template_files(const std::filesystem::path& folder);
[[nodiscard]] std::vector<LandmarkShape> load_landmark_shapes(const std::filesystem::path& folder);  // the same
// Throws ConfigError on what no category can be called.
void check_category(const std::string& category, const SourcePlace& place);
// The text of such a file, which says where it was captured: in the map `of`, a name for people.
[[nodiscard]] std::string template_text(const std::string& category, const CapturedOutline& captured,
                                        const std::string& of);
// What such a file may hold, for the reference and the JSON schema.
[[nodiscard]] Schema template_file_schema();

}  // namespace cairn
