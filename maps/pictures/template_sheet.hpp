// All templates of a set as a PNG, a tile each: hue says where the gradient points (towards what is
// occupied), brightness how steep it is.
#pragma once

#include <filesystem>
#include <string>

#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

// Throws std::runtime_error with the file and the reason when it cannot be written.
void write_template_sheet(const std::filesystem::path& file, const TemplateSet& templates, const std::string& title);

}  // namespace cairn
