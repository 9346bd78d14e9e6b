#include "maps/base/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "maps/base/text.hpp"

namespace cairn::exchange {
namespace {

constexpr std::size_t kMaxPlainKey = 1000;  // bytes; some readers count a little more than the key

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// A letter, then letters, digits and what stands within file names.
bool is_plain(std::string_view text) {
  static constexpr std::array<std::string_view, 12> kMeaning{"true", "false", "yes", "no",   "on",  "off",
                                                             "null", "y",     "n",   "none", "nan", "inf"};
  return !text.empty() && is_letter(text.front()) && std::ranges::find(kMeaning, lower_case(text)) == kMeaning.end() &&
         std::ranges::all_of(
             text, [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.'; });
}

}  // namespace

std::string yaml_number(double value) {
  std::array<char, 512> buffer{};  // enough for every double
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
  std::string text(buffer.data(), end);
  if (text.find('.') == std::string::npos) text += ".0";
  return text;
}

std::string_view without_plus_sign(std::string_view number) {
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  return number;
}

std::string yaml_text(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20U || byte == 0x7FU) {
      quoted += fmt::format("\\x{:02X}", byte);
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string yaml_flow_key(std::string_view text) {
  const std::string key = yaml_text(text);
  return key.size() <= kMaxPlainKey ? key + ":" : "? " + key + " :";
}

std::string yaml_block_key(std::string_view text, std::string_view indent) {
  const std::string key = yaml_text(text);
  if (key.size() <= kMaxPlainKey) return std::string(indent) + key + ":";
  return fmt::format("{0}? {1}\n{0}:", indent, key);
}

}  // namespace cairn::exchange
