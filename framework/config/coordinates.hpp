// Coordinates as people write them: `x,y`, and with the brackets of YAML, `[x, y]`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

// All parts between commas as numbers, however many; none when one is no number, or a bracket has no partner.
[[nodiscard]] std::optional<std::vector<double>> coordinates_in(std::string_view text);

// A point of a mission, as a list or as text: [1, 2], "1,2", "[1, 2]"; none: it is anything else. Throws ConfigError
// when it has not two coordinates.
[[nodiscard]] std::optional<Point> point_in(const ConfigValue& value, const std::string& key);

}  // namespace cairn
