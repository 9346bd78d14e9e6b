// Cells that a behaviour remembers, after an exchange of maps.
#pragma once

#include "maps/geometry/map_move.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "plugins/behaviours/local_map/cell_layer.hpp"

namespace cairn::behaviours {

// Where the cells of the map before lie in the new one, to about a cell. grid: either, they have the same lattice.
[[nodiscard]] CellSet moved_cells(const MapMove& move, const OccupancyGrid& grid, const CellSet& cells);

}  // namespace cairn::behaviours
