// Where things stand in JSON text: slices of a file that a JSON library parses one by one, so that an error has a place
// and a large file needs little memory.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "maps/base/source_text.hpp"

namespace cairn::exchange {

// Deeper nesting is refused: programs that walk JSON by recursion would run out of stack.
inline constexpr std::size_t kMaxJsonDepth = 64;

struct JsonMember {
  std::string_view key;        // as written, escapes and all
  std::size_t key_offset = 0;  // of its opening quote
  std::size_t begin = 0;       // of the value
  std::size_t end = 0;
};

struct JsonSlice {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Both look for brackets, commas and strings only; what is in a value is left to its parser. Both throw ExchangeError
// where the text ends too early, nests deeper than kMaxJsonDepth, or has a key twice in one object.
// The members of the object that begins there; end is set behind it.
[[nodiscard]] std::vector<JsonMember> members_at(const SourceText& source, std::size_t begin, std::size_t& end);
// The items of the array that begins there.
[[nodiscard]] std::vector<JsonSlice> items_at(const SourceText& source, std::size_t begin);

[[nodiscard]] std::size_t skip_blanks(const SourceText& source, std::size_t at);

// The offset of what a path of keys and item numbers leads to from a sound value; of the last part that is there.
[[nodiscard]] std::size_t offset_of(const SourceText& source, std::size_t begin, const std::vector<std::string>& path);

[[nodiscard]] bool is_json_object(std::string_view text);

}  // namespace cairn::exchange
