// Small spots of a map that are more likely to be left over from somebody who passed than to be there.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::behaviours {

struct SpeckleSettings {
  int max_occupied_cells = 4;
  int max_cells = 80;
  static void describe(Fields<SpeckleSettings>& fields);
};

// The cells of those groups (8 neighbours) of unknown and occupied cells in the box which hold few occupied cells
// and few at all; groups that touch the box's rim are none. In order.
[[nodiscard]] std::vector<Cell> speckles_of(const OccupancyGrid& grid, const CellBox& box,
                                            const SpeckleSettings& settings = {});

}  // namespace cairn::behaviours
