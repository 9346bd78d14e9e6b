// Bytes packed by zlib (RFC 1950), and by gzip (RFC 1952).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {

// At one level everywhere: the same bytes give the same.
[[nodiscard]] std::string deflated(std::string_view bytes);
// Throws std::invalid_argument when they do not unpack to exactly that size; never takes memory that they cannot fill.
[[nodiscard]] std::string inflated(std::string_view packed, std::size_t size);

// One member of a gzip file; members one after the other are a file. Throws std::length_error for more than 4 GB.
[[nodiscard]] std::string gzip_member(std::string_view bytes);

}  // namespace cairn
