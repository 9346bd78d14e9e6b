// Paths that touch or come too near to things, moved clear of them.
#pragma once

#include <vector>

#include "framework/contracts/budget.hpp"
#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

inline constexpr double kPointRadius_m = 2.0 * kMinRadius_m;  // a disc of so little is a point

// A shortest path of a point, which turns at corners of what is blocked and grazes others, moved off them by a few
// micrometres, so that a point's disc fits.
[[nodiscard]] std::vector<Point> off_corners(const DiscSpace& space, const std::vector<Point>& path);

// A path that is too near to things for the disc, moved off them point by point; empty where that does not do.
// It sees passages as narrow as the disc plus a small part of a cell.
[[nodiscard]] std::vector<Point> pushed_clear(const DiscSpace& space, const std::vector<Point>& path, double radius_m,
                                              const Budget& budget);

}  // namespace cairn
