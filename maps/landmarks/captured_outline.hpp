// The outline of a thing in a map, as a template of it has it.
#pragma once

#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// Of all things (occupied cells that hang together, gaps of up to four cells closed) that lie wholly within
// the radius of a point and cover at least four cells. In the frame of the map, about their centroid; one
// cell inside the cells' edges and without spikes, since range sensors smear an outline outward (docs/method.md 6.3).
// Throws std::invalid_argument, with what is there instead, when there is none.
struct CapturedOutline {
  Contour contour;
  Point at_m{0.0, 0.0};  // its centroid in the map
};
[[nodiscard]] CapturedOutline captured_outline(const OccupancyGrid& grid, const Point& at_m, double radius_m);

}  // namespace cairn
