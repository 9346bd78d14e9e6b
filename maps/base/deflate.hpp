// Bytes packed by zlib (RFC 1950).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {

// At one level everywhere: the same bytes give the same.
[[nodiscard]] std::string deflated(std::string_view bytes);
// Throws std::invalid_argument when they do not unpack to exactly that size; never takes memory that they cannot fill.
[[nodiscard]] std::string inflated(std::string_view packed, std::size_t size);

}  // namespace cairn
