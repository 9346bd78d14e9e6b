// What importing an occupancy grid gives.
#pragma once

#include <string>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct ImportedGrid {
  OccupancyGrid grid;
  std::vector<std::string> warnings;  // sentences: by which rule something doubtful was accepted
};

}  // namespace cairn
