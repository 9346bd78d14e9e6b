#include "maps/base/base64.hpp"

#include <algorithm>
#include <stdexcept>

namespace cairn {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

unsigned value_of(char digit) {
  const std::size_t value = kDigits.find(digit);
  if (value == std::string_view::npos) throw std::invalid_argument("base64: a character that is no digit");
  return static_cast<unsigned>(value);
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8U | (j < count ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? kDigits[group >> (18U - 6U * j) & 63U] : '=';
  }
  return text;
}

std::vector<std::uint8_t> bytes_of_base64(std::string_view text) {
  if (text.size() % 4 != 0) throw std::invalid_argument("base64: its length is no multiple of 4");
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  const std::string_view digits = text.substr(0, text.size() - padding);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  unsigned group = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    group = group << 6U | (i < digits.size() ? value_of(digits[i]) : 0U);
    if (i % 4 != 3) continue;
    for (unsigned shift = 24; shift > 0;) bytes.push_back(static_cast<std::uint8_t>(group >> (shift -= 8)));
    group = 0;
  }
  bytes.resize(bytes.size() - padding);
  if (base64(bytes) != text) throw std::invalid_argument("base64: bits beyond its bytes");
  return bytes;
}

}  // namespace cairn
