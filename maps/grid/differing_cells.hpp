// Where two grids differ.
#pragma once

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// A box that holds every cell in which two grids of the same cell size, origin and bounds differ; by whole tiles.
[[nodiscard]] CellBox differing_cells(const OccupancyGrid& a, const OccupancyGrid& b);

}  // namespace cairn
