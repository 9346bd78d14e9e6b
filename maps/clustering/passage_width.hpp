// How narrow the narrowest place of a route is.
#pragma once

#include <span>

#include "maps/geometry/pose.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// The shortest straight line through a point of the trajectory, across the direction of travel by at most 45 deg more
// or less, from the nearest cell on one side that is not free to the nearest one on the other. In a doorway that is
// the width of the door, wherever in it and however obliquely the trajectory passes; beside a wall of a room it is the
// width of the room. Unknown cells are not free. Landmarks are no walls: what is within 0.5 m of one counts as free. At
// most max_m, which is also what a trajectory of fewer than two places has; exact to about a cell.
// O(length * max_m / cell^2).
[[nodiscard]] double passage_width_m(std::span<const Pose2> trajectory, const OccupancyGrid& grid,
                                     std::span<const Point> landmarks_m, double max_m);

}  // namespace cairn
