#include "maps/grid/swept_disc.hpp"

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

double distance_to_box_m(const Point& p, double half_m) {
  return std::hypot(std::max(std::abs(p.x()) - half_m, 0.0), std::max(std::abs(p.y()) - half_m, 0.0));
}

// Clips the segment against |x| <= half and |y| <= half.
bool meets_box(const Point& from, const Point& to, double half_m) {
  double t_in = 0.0;
  double t_out = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = to[axis] - from[axis];
    if (step == 0.0) {
      if (std::abs(from[axis]) > half_m) return false;
      continue;
    }
    const double t_low = (-half_m - from[axis]) / step;
    const double t_high = (half_m - from[axis]) / step;
    t_in = std::max(t_in, std::min(t_low, t_high));
    t_out = std::min(t_out, std::max(t_low, t_high));
  }
  return t_in <= t_out;
}

}  // namespace

double distance_to_square_m(const Point& from, const Point& to, const Point& square_centre, double side_m) {
  const double half_m = 0.5 * side_m;
  const Point a = from - square_centre;
  const Point b = to - square_centre;
  if (meets_box(a, b, half_m)) return 0.0;
  double nearest_m = std::min(distance_to_box_m(a, half_m), distance_to_box_m(b, half_m));
  for (const double x : {-half_m, half_m})
    for (const double y : {-half_m, half_m}) nearest_m = std::min(nearest_m, distance_to_segment_m({x, y}, a, b));
  return nearest_m;
}

bool sweep_is_free(const OccupancyGrid& grid, const GroundRules& rules, const Point& from, const Point& to,
                   double radius_m) {
  if (!from.allFinite() || !to.allFinite()) return false;
  return !sweep_touches({grid.origin_m(), grid.cell_m()}, from, to, radius_m,
                        [&](Cell cell) { return rules.blocks(grid.state(cell, rules.thresholds)); });
}

}  // namespace cairn
