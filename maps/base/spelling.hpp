// Names in messages: the nearest known one, and how a text from outside is shown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cairn {

// The candidate with the smallest edit distance to the name, or empty when none is near.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);
// ` (did you mean "x"?)` or empty.
[[nodiscard]] std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

// A name or value in quotes for a message: one line, at most 60 bytes of it.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace cairn
