// Small spots of a map that are more likely to be left over from somebody who passed than to be there.
#pragma once

#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn::behaviours {

// The cells of those groups (8 neighbours) of unknown and occupied cells in the box which hold few occupied cells
// (at most max_occupied) and few at all (at most max_cells); groups that touch the box's rim are none. In order.
[[nodiscard]] std::vector<Cell> speckles_of(const OccupancyGrid& grid, const CellBox& box, int max_occupied = 4,
                                            int max_cells = 80);

}  // namespace cairn::behaviours
