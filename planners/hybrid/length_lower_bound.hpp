// How long a path across a large grid must be at least, from coarse blocks of its cells.
#pragma once

#include "framework/contracts/budget.hpp"
#include "maps/grid/swept_disc.hpp"

namespace cairn {

// No path for the disc between the two points is shorter, nor is the lower bound that DiscRoutes gives. +inf when
// there is no path; 0 when the budget ends first. It works on blocks of cells, about as large as the disc's radius:
// it cuts turns shorter, and goes through gaps that only just are too narrow.
//
// Takes O(cells) bit operations and a mesh of the blocks, which are single cells where the radius is below 1.5 of them;
// no distance field.
[[nodiscard]] double length_lower_bound_m(const OccupancyGrid& grid, const GroundRules& rules, double radius_m,
                                          const Point& from, const Point& to, const Budget& budget);

}  // namespace cairn
