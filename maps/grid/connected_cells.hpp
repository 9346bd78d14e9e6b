// Which cells hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/distance_field.hpp"

namespace cairn {

// A number for each cell of the field's box, row-major: 0 where it is blocked, else the same for all cells that
// can be reached from each other over shared sides. O(cells).
[[nodiscard]] std::vector<std::int32_t> connected_cells(const DistanceField& field);

}  // namespace cairn
