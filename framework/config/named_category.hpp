// Categories of landmarks that a mission names: are there templates of them?
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.hpp"

namespace cairn {

// Nothing, or `nearest` without what.
[[nodiscard]] bool names_nothing(std::string_view text);

// Throws ConfigError at the place when the category is none of the known ones, with the nearest of them. No known ones:
// nobody knows, so that everything but an empty text is fine. what: that names it, such as "goto".
void check_category_is_known(const std::string& category, const SourcePlace& place, const std::string& what,
                             const std::vector<std::string>& categories);

// The same for each `nearest CATEGORY` among the texts of a value: a text, or a list of texts and of points. Other
// texts are ids and names, which only a map knows.
void check_named_categories(const ConfigValue& value, const std::string& what,
                            const std::vector<std::string>& categories);

}  // namespace cairn
