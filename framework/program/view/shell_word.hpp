// Texts in command lines that are printed for people to copy.
#pragma once

#include <string>

namespace cairn {

// As one word of a shell, in quotes.
[[nodiscard]] inline std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace cairn
