// What the sensors would newly see from a viewpoint.
#pragma once

#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

// Square metres of unknown cells in line of sight of a viewpoint within the range, counted over rays; what is unknown
// hides nothing. The potential visibility gain of Gonzalez-Banos and Latombe, Navigation strategies for exploring
// indoor environments, IJRR 21 (10-11), 2002, section 4.3.
[[nodiscard]] double new_area_m2(const FreeSpace& space, const Point& viewpoint, double range_m);

// Metres of path that a viewpoint may be further off for what it shows. Their rule takes the viewpoint with the largest
// A exp(-lambda L), A the new area and L the path: the same as the least L - ln(A) / lambda. worth_m is 1 / lambda.
// Finite; less than a hundredth of a square metre is taken for that.
[[nodiscard]] double worth_of_area_m(double area_m2, double worth_m);

}  // namespace cairn::behaviours
