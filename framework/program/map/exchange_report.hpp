// How the commands that read and write files of other tools report what they have done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

// "FILE: cannot be VERB: unknown extension ..." with the nearest known one. Throws std::runtime_error.
[[noreturn]] void fail_extension(const std::filesystem::path& file, const char* verb,
                                 const std::vector<std::string>& known);
// Warnings with the file that they are about in front.
[[nodiscard]] std::vector<std::string> about(const std::filesystem::path& file, std::vector<std::string> warnings);

}  // namespace cairn
