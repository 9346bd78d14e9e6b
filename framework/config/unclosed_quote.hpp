// A quote that is opened in a YAML text and never closed.
#pragma once

#include <optional>
#include <string>

#include "framework/config/config_value.hpp"

namespace cairn {

// Where it is opened; none when every quote is closed. yaml-cpp takes the end of the text for the end of the quote, so
// that all that follows would silently be one string. The text must be one that yaml-cpp reads, or fails in a quote.
[[nodiscard]] std::optional<SourcePlace> unclosed_quote(const std::string& text, const std::string& file);

}  // namespace cairn
