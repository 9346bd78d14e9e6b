// Files of the data folder, most of which are packed.
#pragma once

#include <filesystem>
#include <string>

namespace cairn {

// The file's bytes, with or without gzip round them. Throws std::runtime_error when it is missing, broken or empty.
[[nodiscard]] std::string unpacked(const std::filesystem::path& file);

// $CAIRN_DATA, else ../shared/data beside the folder one works in.
[[nodiscard]] std::filesystem::path data_folder();

}  // namespace cairn
