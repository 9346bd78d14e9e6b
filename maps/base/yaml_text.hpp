// Scalars of YAML files that are written for other tools.
#pragma once

#include <string>
#include <string_view>

namespace cairn::exchange {

// The shortest decimal that reads back as the same double, without an exponent, which some readers take for text.
[[nodiscard]] std::string yaml_number(double value);
// In double quotes with escapes unless it is a plain name that no reader takes for anything else.
[[nodiscard]] std::string yaml_text(std::string_view text);

}  // namespace cairn::exchange
