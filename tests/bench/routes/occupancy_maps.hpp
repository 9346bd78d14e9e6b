// The occupancy grids of the data folder: those that robots and their users share as map_server files.
#pragma once

#include <string>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct OccupancyMap {
  std::string name;
  OccupancyGrid grid;
};

// Those with a YAML file, packed or not, and four floor plans of 0.05 m a pixel; in order of their files. None when
// the folder is not there.
[[nodiscard]] std::vector<OccupancyMap> occupancy_maps();

}  // namespace cairn
