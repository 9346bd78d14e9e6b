// Coordinates as people write them: `x,y`, and with the brackets of YAML, `[x, y]`.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace cairn {

// All parts between commas as numbers, however many; none when one is no number, or a bracket has no partner.
[[nodiscard]] std::optional<std::vector<double>> coordinates_in(std::string_view text);

}  // namespace cairn
