#include "framework/modules/printable.hpp"

#include <algorithm>

#include "maps/base/source_text.hpp"

namespace cairn {

std::string printable(std::string_view text, std::size_t max_bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto byte_at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  std::size_t end = std::min(text.size(), max_bytes);
  while (end < text.size() && end > 0 && (byte_at(end) & 0xC0U) == 0x80U) --end;  // not within a UTF-8 character
  const bool is_utf8 = exchange::first_not_utf8(text.substr(0, end)) == std::string_view::npos;
  // U+0080 to U+009F are control characters too.
  const auto is_wide_control = [&](std::size_t i) { return byte_at(i) == 0xC2U && byte_at(i + 1) < 0xA0U; };
  std::string out;
  for (std::size_t i = 0; i < end; ++i) {
    const unsigned byte = byte_at(i);
    const bool is_within_wide = byte >= 0x80U && is_utf8 && !is_wide_control(i) && (i == 0 || !is_wide_control(i - 1));
    if (byte == '\n')
      out += "\\n";
    else if ((byte >= 0x20U && byte < 0x7FU) || is_within_wide)
      out += text[i];
    else
      out.append("\\x").append(1, kDigits[byte >> 4U]).append(1, kDigits[byte & 0xFU]);
  }
  return end < text.size() ? out + "..." : out;
}

}  // namespace cairn
