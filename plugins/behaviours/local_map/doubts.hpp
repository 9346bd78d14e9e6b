// What looking at a blockage leaves doubtful on the map.
#pragma once

#include <vector>

#include "maps/geometry/pose.hpp"
#include "plugins/behaviours/local_map/cell_layer.hpp"

namespace cairn::behaviours {

struct Doubts {
  std::vector<Cell> seen_through;  // echoes have come from behind these cells
  CellSet gone;                    // at least as often as not: the robot need not slow down for these
  std::vector<Point> looked_at;    // what stands alone about these places is there only if it echoes
  double island_radius_m = 0.7;
};

}  // namespace cairn::behaviours
