// Whether two texts are the same, without keeping them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cairn {

// FNV-1a, 64 bits: against change by accident, not by malice.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes);
// The same as 16 hexadecimal digits.
[[nodiscard]] std::string fingerprint_of(std::string_view text);

}  // namespace cairn
