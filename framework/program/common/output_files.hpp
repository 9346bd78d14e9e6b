// What the commands write: folders and whole files, or an error that says which.
#pragma once

#include <filesystem>
#include <string>

namespace cairn {

// Throw std::runtime_error.
// Holds a folder for one run at a time, as long as the process lives. Throws std::runtime_error when another holds it.
void hold_folder(const std::filesystem::path& folder);

void make_folder(const std::filesystem::path& folder);
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace cairn
