// Which cells a disc touches while its centre moves along a straight segment, exactly.
//
// A cell is the closed square of side cell_m round its centre; the disc touches it when the distance
// between segment and square is less than the radius. A radius of 0 counts as a micrometre, so that a
// point never slips through the corner where two blocked cells meet.
#pragma once

#include <algorithm>
#include <cmath>

#include "maps/grid/distance_field.hpp"

namespace cairn {

// What a robot must not touch: occupied cells, and unknown ones when they are avoided.
struct GroundRules {
  UnknownPolicy unknown = UnknownPolicy::avoid;
  OccupancyThresholds thresholds;

  [[nodiscard]] bool blocks(CellState state) const {
    return state == CellState::occupied || (state == CellState::unknown && unknown == UnknownPolicy::avoid);
  }
  bool operator==(const GroundRules& other) const {
    return unknown == other.unknown && thresholds.free_below == other.thresholds.free_below &&
           thresholds.occupied_above == other.thresholds.occupied_above;
  }
};

inline constexpr double kMinRadius_m = 1e-6;

// Distance between a segment and a square, borders included; 0 when they meet.
[[nodiscard]] double distance_to_square_m(const Point& from, const Point& to, const Point& square_centre,
                                          double side_m);

// A cell lattice: where cell (0, 0) begins and how large a cell is.
struct Lattice {
  Point origin_m{0.0, 0.0};
  double cell_m = 0.05;

  [[nodiscard]] Point centre_of(Cell cell) const {
    return {origin_m.x() + (cell.x + 0.5) * cell_m, origin_m.y() + (cell.y + 0.5) * cell_m};
  }
};

// True when found(Cell) holds for a cell that comes within reach_m of the segment. Every such cell is
// asked about, and some that lie a little further off. Work: the cells under the sweep.
template <class Found>
[[nodiscard]] bool any_cell_near(const Lattice& lattice, const Point& from, const Point& to, double reach_m,
                                 Found found) {
  const auto index = [&](double at_m, double origin_m) {
    return static_cast<int>(std::floor((at_m - origin_m) / lattice.cell_m));
  };
  const auto [y_low, y_high] = std::minmax(from.y(), to.y());
  for (int y = index(y_low - reach_m, lattice.origin_m.y()); y <= index(y_high + reach_m, lattice.origin_m.y()); ++y) {
    // The part of the segment that can reach into this row of cells, as x.
    double x_a = from.x();
    double x_b = to.x();
    if (from.y() != to.y()) {
      const double row_m = lattice.origin_m.y() + y * lattice.cell_m;
      const double slope = (to.x() - from.x()) / (to.y() - from.y());
      x_a += (std::clamp(row_m - reach_m, y_low, y_high) - from.y()) * slope;
      x_b = from.x() + (std::clamp(row_m + lattice.cell_m + reach_m, y_low, y_high) - from.y()) * slope;
    }
    const auto [x_low, x_high] = std::minmax(x_a, x_b);
    const int x_end = index(x_high + reach_m, lattice.origin_m.x());
    for (int x = index(x_low - reach_m, lattice.origin_m.x()); x <= x_end; ++x)
      if (found(Cell{x, y})) return true;
  }
  return false;
}

// True when is_blocked(Cell) holds for a cell that the disc touches.
template <class IsBlocked>
[[nodiscard]] bool sweep_touches(const Lattice& lattice, const Point& from, const Point& to, double radius_m,
                                 IsBlocked is_blocked) {
  const double reach_m = std::max(radius_m, kMinRadius_m);
  return any_cell_near(lattice, from, to, reach_m, [&](Cell cell) {
    return is_blocked(cell) && distance_to_square_m(from, to, lattice.centre_of(cell), lattice.cell_m) < reach_m;
  });
}

// The re-check of finished paths: straight from the grid, every cell under the sweep.
[[nodiscard]] bool sweep_is_free(const OccupancyGrid& grid, const GroundRules& rules, const Point& from,
                                 const Point& to, double radius_m);

}  // namespace cairn
