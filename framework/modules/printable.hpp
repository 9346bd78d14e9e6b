// Text of others in a message: nothing in it can move a terminal's cursor or break a line.
#pragma once

#include <string>
#include <string_view>

namespace cairn {

// Control characters, and all that is not ASCII when the text is not UTF-8, as \n or \x1b; cut after so many bytes of
// the text, with "..." in their place.
[[nodiscard]] std::string printable(std::string_view text, std::size_t max_bytes = 400);

}  // namespace cairn
