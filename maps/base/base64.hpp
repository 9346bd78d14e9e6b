// Bytes as text, base 64 (RFC 4648, with padding).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
// Throws std::invalid_argument on what base64() writes for no bytes.
[[nodiscard]] std::vector<std::uint8_t> bytes_of_base64(std::string_view text);

}  // namespace cairn
