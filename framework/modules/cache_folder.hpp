// Folders where the program keeps what it can find out again.
#pragma once

#include <filesystem>
#include <string>

namespace cairn {

// What the environment variable names, a folder or `off`; without it $XDG_CACHE_HOME/cairn/NAME or
// ~/.cache/cairn/NAME. Empty: none.
[[nodiscard]] std::filesystem::path cache_folder(const char* variable, const std::string& name);

// Writes the file of such a folder in one step, so that processes can share it; makes the folder when it is not there.
// A file that cannot be written is left as it was.
void keep_in_cache(const std::filesystem::path& file, const std::string& bytes);

}  // namespace cairn
