// Scalars of YAML files that are written for other tools.
#pragma once

#include <string>
#include <string_view>

namespace cairn::exchange {

// The shortest decimal that reads back as the same double, without an exponent, which some readers take for text.
[[nodiscard]] std::string yaml_number(double value);
// YAML lets a number begin with a plus sign, std::from_chars does not: the rest of it.
[[nodiscard]] std::string_view without_plus_sign(std::string_view number);
// In double quotes with escapes unless it is a plain name that no reader takes for anything else.
[[nodiscard]] std::string yaml_text(std::string_view text);
// The same as the key of a mapping, with its colon: in one line with others (flow style), or at the beginning of a line
// behind that indent. Keys of more than 1024 characters have to be marked as such (YAML 1.2, 7.4.3 and 8.2.2).
[[nodiscard]] std::string yaml_flow_key(std::string_view text);
[[nodiscard]] std::string yaml_block_key(std::string_view text, std::string_view indent = "");

}  // namespace cairn::exchange
