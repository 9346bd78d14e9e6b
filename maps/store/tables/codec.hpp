// Bytes of the saved map: little-endian numbers, packed ones (maps/base/deflate.hpp), CRC-32.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace cairn::store {

// What deflated() has packed. Throws StoreError when it does not unpack to exactly raw_size bytes.
[[nodiscard]] std::string unpacked_bytes(const std::string& packed, std::size_t raw_size);
[[nodiscard]] std::uint32_t crc32_of(std::string_view bytes, std::uint32_t crc_before = 0);

template <std::size_t kBytes>
using Unsigned = std::conditional_t<kBytes == 2, std::uint16_t, std::uint64_t>;

// Number is std::int16_t, std::int64_t or double.
template <typename Number>
void append_little_endian(std::string& bytes, Number value) {
  const auto bits = std::bit_cast<Unsigned<sizeof(Number)>>(value);
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes.push_back(static_cast<char>((bits >> (8 * i)) & 0xFF));
}

template <typename Number>
[[nodiscard]] Number little_endian_at(std::string_view bytes, std::size_t offset) {
  Unsigned<sizeof(Number)> bits = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;)
    bits = static_cast<decltype(bits)>((bits << 8) | static_cast<unsigned char>(bytes[offset + i]));
  return std::bit_cast<Number>(bits);
}

}  // namespace cairn::store
