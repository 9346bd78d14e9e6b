// Where two grids differ.
#pragma once

#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// A box that holds every cell in which two grids of the same cell size, origin and bounds differ; by whole tiles.
[[nodiscard]] CellBox differing_cells(const OccupancyGrid& a, const OccupancyGrid& b);
// The centres of all cells whose state (free, occupied, unknown) differs between two grids of the same cell size and
// origin, row by row of their tiles. O(cells), and little for tiles that are equal.
[[nodiscard]] std::vector<Point> centres_of_changed_states(const OccupancyGrid& before, const OccupancyGrid& after);

}  // namespace cairn
