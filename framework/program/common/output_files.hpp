// Where the commands write: the folders, and the lock of a run's.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "maps/base/output_file.hpp"

namespace cairn {

// The lock file in an output folder, which a run holds as long as its process lives. It holds the process's id.
inline constexpr const char* kFolderLock = ".cairn.lock";

// All throw std::runtime_error.
// Holds a folder for one run at a time. Another run that is about to end is waited for.
void hold_folder(const std::filesystem::path& folder, std::chrono::milliseconds within = std::chrono::seconds(3));
// Whether a run holds it now. Never throws; false where the lock cannot be read.
[[nodiscard]] bool is_folder_held(const std::filesystem::path& folder);

void make_folder(const std::filesystem::path& folder);

// A file that was asked for by name, or the usual one, which takes the place of no other. Throws when there is one.
[[nodiscard]] std::filesystem::path file_to_write(const std::filesystem::path& named, const std::string& usual);

}  // namespace cairn
