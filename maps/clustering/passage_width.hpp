// How narrow the narrowest place of a route is.
#pragma once

#include <span>

#include "maps/geometry/pose.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// The shortest straight line through a point of the trajectory, across the direction of travel by at most 45 deg more
// or less, from the nearest cell on one side that is not free to the nearest one on the other. In a doorway that is
// the width of the door, wherever in it and however obliquely the trajectory passes; beside a wall of a room it is the
// width of the room. Unknown cells are not free. The first and the last 0.8 m do not
// count: the gap between a landmark and the wall behind it is no passage. At most max_m, which is also what a
// trajectory of fewer than two places has; exact to about a cell. O(length * max_m / cell^2).
[[nodiscard]] double passage_width_m(std::span<const Pose2> trajectory, const OccupancyGrid& grid, double max_m);

}  // namespace cairn
