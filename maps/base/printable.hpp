// Characters that steer a terminal or mislead who reads: the control characters of ASCII (C0, DEL) and of Latin 1 (C1),
// and the Unicode characters that turn the direction of the text around them (bidirectional embeddings, overrides and
// isolates). No name from a file may hold one, and none is printed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {

inline constexpr std::string_view kLineCharacters = "\n\t\r";  // what texts of several lines may hold

// The offset of the first such character, or of the first byte that belongs to no UTF-8 character; npos when there is
// none. Control characters of ASCII that are among the allowed ones pass.
[[nodiscard]] std::size_t first_unprintable(std::string_view text, std::string_view allowed = {});

// The text with those written as "\x1b" (ASCII, and bytes that are no UTF-8) or "\u202e". What JSON escapes already
// stays the same JSON value.
[[nodiscard]] std::string printable(std::string_view text, std::string_view allowed = {});

// The same of its first bytes, with "..." for the rest; not cut within a character.
[[nodiscard]] std::string printable_excerpt(std::string_view text, std::size_t max_bytes = 400);

// "the control character \x1b" for an error about the character at that offset.
[[nodiscard]] std::string name_of_unprintable(std::string_view text, std::size_t offset);

}  // namespace cairn
