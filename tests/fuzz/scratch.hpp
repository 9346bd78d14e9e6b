// A folder in memory for readers that want files. Nothing is written anywhere else.
#pragma once

#include <filesystem>
#include <string>

#include "tests/fuzz/reader.hpp"

namespace cairn::fuzz {

// The process's own, below /dev/shm; gone when the process ends by itself.
[[nodiscard]] const std::filesystem::path& scratch();
// The bytes as a file of that name in it.
std::filesystem::path scratch_file(const std::string& name, std::string_view bytes);

}  // namespace cairn::fuzz
