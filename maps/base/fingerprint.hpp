// Whether two texts or files are the same, without keeping them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cairn {

// XXH3, 64 bits: against change by accident, not by malice.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes);
// The same as 16 hexadecimal digits.
[[nodiscard]] std::string fingerprint_of(std::string_view text);

struct FileHash {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

// Of a plain file's bytes, a piece at a time; empty when it is none or cannot be read.
[[nodiscard]] std::optional<FileHash> hash_of_file(const std::filesystem::path& file);

}  // namespace cairn
