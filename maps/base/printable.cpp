#include "maps/base/printable.hpp"

#include <fmt/format.h>

#include <boost/locale/utf.hpp>

namespace cairn {
namespace {

namespace utf = boost::locale::utf;

constexpr utf::code_point kDelete = 0x7F;

bool is_plain_ascii(char c) {
  return c >= ' ' && c < static_cast<char>(kDelete);
}

bool steers(utf::code_point code) {
  const bool is_control = code < 0x20 || (code >= kDelete && code < 0xA0);
  const bool turns_direction = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return is_control || turns_direction;
}

struct Character {
  std::size_t bytes = 1;
  utf::code_point code = 0;
  bool is_utf8 = false;
};

Character character_at(std::string_view text, std::size_t offset) {
  const char* const begin = text.data() + offset;
  const char* at = begin;
  const utf::code_point code = utf::utf_traits<char>::decode(at, text.data() + text.size());
  if (code == utf::illegal || code == utf::incomplete) return {};
  return {static_cast<std::size_t>(at - begin), code, true};
}

bool may_stand(const Character& character, std::string_view allowed) {
  if (!character.is_utf8) return false;
  if (!steers(character.code)) return true;
  return character.code < kDelete && allowed.find(static_cast<char>(character.code)) != std::string_view::npos;
}

std::string escaped(std::string_view text, std::size_t offset, const Character& character) {
  if (!character.is_utf8 || character.code < 0x20)
    return fmt::format("\\x{:02x}", static_cast<unsigned char>(text[offset]));
  return fmt::format("\\u{:04x}", character.code);
}

}  // namespace

std::size_t first_unprintable(std::string_view text, std::string_view allowed) {
  for (std::size_t at = 0; at < text.size();) {
    if (is_plain_ascii(text[at])) {
      ++at;
      continue;
    }
    const Character character = character_at(text, at);
    if (!may_stand(character, allowed)) return at;
    at += character.bytes;
  }
  return std::string_view::npos;
}

std::string printable(std::string_view text, std::string_view allowed) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const std::size_t found = first_unprintable(text, allowed);
    shown += text.substr(0, found);
    if (found == std::string_view::npos) break;
    const Character character = character_at(text, found);
    shown += escaped(text, found, character);
    text.remove_prefix(found + character.bytes);
  }
  return shown;
}

std::string printable_excerpt(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return printable(text);
  const auto is_inside_a_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  while (max_bytes > 0 && is_inside_a_character(max_bytes)) --max_bytes;
  return printable(text.substr(0, max_bytes)) + "...";
}

std::string name_of_unprintable(std::string_view text, std::size_t offset) {
  const Character character = character_at(text, offset);
  return (character.is_utf8 ? "the control character " : "the byte ") + escaped(text, offset, character);
}

}  // namespace cairn
