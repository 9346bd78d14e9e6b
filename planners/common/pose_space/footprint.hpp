// The outline of a robot, and whether it touches cells of a grid.
//
// Touching is meant as in swept_disc.hpp: cells are closed squares, and an outline touches one when it
// comes nearer than a reach of at least a micrometre, or holds it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "maps/grid/swept_disc.hpp"

namespace cairn {

// A disc round the robot's origin, or a polygon in the robot's frame; concave ones are as good, and the
// origin may lie anywhere.
class Footprint {
 public:
  struct Disc {
    Point centre{0.0, 0.0};
    double radius_m = 0.0;
  };

  // Throw std::invalid_argument on a radius that is negative or not finite, and on corners that are no Contour.
  [[nodiscard]] static Footprint disc(double radius_m);
  [[nodiscard]] static Footprint polygon(std::vector<Point> corners_m);

  [[nodiscard]] bool is_disc() const { return corners_m_.empty(); }
  [[nodiscard]] const std::vector<Point>& corners_m() const { return corners_m_; }  // anticlockwise
  [[nodiscard]] double inscribed_m() const { return inscribed_m_; }  // round the origin; 0 when that is outside
  [[nodiscard]] double circumscribed_m() const { return circumscribed_m_; }
  // Discs that together hold the outline, and as little more as a few can.
  [[nodiscard]] const std::vector<Disc>& cover() const { return cover_; }

 private:
  Footprint() = default;

  std::vector<Point> corners_m_;
  double inscribed_m_ = 0.0;
  double circumscribed_m_ = 0.0;
  std::vector<Disc> cover_;
};

// Whether a solid polygon comes nearer than reach_m to a cell, or holds it.
[[nodiscard]] bool is_near(std::span<const Point> corners, double reach_m, const Lattice& lattice, Cell cell);

// The x of all that the polygon's rim has between two heights; empty (low > high) when it has nothing.
struct Span {
  double low;
  double high;
};
[[nodiscard]] Span span_between(std::span<const Point> corners, double y_low, double y_high);

// True when a solid polygon comes nearer than reach_m to a blocked cell, or holds one.
// free_run(cell): 0 for a blocked cell, otherwise how many cells from this one on, it included, are known
// not to be blocked in its row; 1 is always right.
template <class FreeRun>
[[nodiscard]] bool polygon_touches(const Lattice& lattice, std::span<const Point> corners, double reach_m,
                                   FreeRun free_run) {
  const auto index = [&](double at_m, double origin_m) {
    return static_cast<int>(std::floor((at_m - origin_m) / lattice.cell_m));
  };
  double y_low = corners[0].y();
  double y_high = y_low;
  for (const Point& corner : corners) {
    y_low = std::min(y_low, corner.y());
    y_high = std::max(y_high, corner.y());
  }
  const int y_end = index(y_high + reach_m, lattice.origin_m.y());
  for (int y = index(y_low - reach_m, lattice.origin_m.y()); y <= y_end; ++y) {
    const double row_m = lattice.origin_m.y() + y * lattice.cell_m;
    const Span span = span_between(corners, row_m - reach_m, row_m + lattice.cell_m + reach_m);
    if (span.low > span.high) continue;
    const int x_end = index(span.high + reach_m, lattice.origin_m.x());
    for (int x = index(span.low - reach_m, lattice.origin_m.x()); x <= x_end;) {
      const int run = free_run(Cell{x, y});
      if (run == 0 && is_near(corners, reach_m, lattice, {x, y})) return true;
      x += std::max(run, 1);
    }
  }
  return false;
}

}  // namespace cairn
