#include "tests/bench/routes/path_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr double kEps = kPathTolerance_cells;

struct Segment {  // in cells
  Point a;
  Point b;
};

// Whether the segment meets the closed rectangle (Liang and Barsky).
bool meets(const Segment& s, const Point& low, const Point& high) {
  double begin = 0.0;
  double end = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = s.b[axis] - s.a[axis];
    if (step == 0.0) {
      if (s.a[axis] < low[axis] || s.a[axis] > high[axis]) return false;
      continue;
    }
    const auto [in, out] = std::minmax({(low[axis] - s.a[axis]) / step, (high[axis] - s.a[axis]) / step});
    begin = std::max(begin, in);
    end = std::min(end, out);
  }
  return begin <= end;
}

double distance(const Segment& s, const Point& p) {
  const Point along = s.b - s.a;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - s.a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (s.a + share * along - p).norm();
}

// Of two convex shapes that do not meet, one is nearest to the other at a corner.
double distance_to_cell(const Segment& s, int x, int y) {
  const Point low(x, y);
  const Point high(x + 1, y + 1);
  if (meets(s, low, high)) return 0.0;
  double least =
      std::min((s.a.cwiseMax(low).cwiseMin(high) - s.a).norm(), (s.b.cwiseMax(low).cwiseMin(high) - s.b).norm());
  for (const Point& corner : {low, high, Point(low.x(), high.y()), Point(high.x(), low.y())})
    least = std::min(least, distance(s, corner));
  return least;
}

// Calls look(x, y) for every cell that comes within `reach` of the segment, and for some others.
template <class Look>
void each_cell_near(const Segment& s, double reach, Look look) {
  const auto whole = [](double v) { return static_cast<int>(std::floor(v)); };
  const auto [y_low, y_high] = std::minmax({s.a.y(), s.b.y()});
  for (int y = whole(y_low - reach); y <= whole(y_high + reach); ++y) {
    double begin = 0.0;  // the part of the segment that may be near this row, as shares of it
    double end = 1.0;
    if (s.a.y() != s.b.y()) {
      const double step = s.b.y() - s.a.y();
      const auto [in, out] = std::minmax({(y - reach - s.a.y()) / step, (y + 1 + reach - s.a.y()) / step});
      begin = std::clamp(in, 0.0, 1.0);
      end = std::clamp(out, 0.0, 1.0);
    }
    const auto [x_low, x_high] =
        std::minmax({s.a.x() + begin * (s.b.x() - s.a.x()), s.a.x() + end * (s.b.x() - s.a.x())});
    for (int x = whole(x_low - reach); x <= whole(x_high + reach); ++x) look(x, y);
  }
}

// Two closed cells meet at this lattice point, the other two are open.
bool is_pinched(const PlainCells& cells, int x, int y) {
  const bool low = cells.is_open(x - 1, y - 1);
  const bool right = cells.is_open(x, y - 1);
  return low != right && cells.is_open(x, y) == low && cells.is_open(x - 1, y) == right;
}

std::string text_of(double x, double y) {
  return "(" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

std::string fault_of_point_segment(const PlainCells& cells, const Segment& s) {
  std::string fault;
  each_cell_near(s, 2.0 * kEps, [&](int x, int y) {
    if (!fault.empty()) return;
    if (is_pinched(cells, x, y) && distance(s, Point(x, y)) <= kEps)
      fault = "slips between two closed cells at the corner " + text_of(x, y);
    if (cells.is_open(x, y)) return;
    // Grown into a closed neighbour, so that no gap is left between the two.
    const Point low(x + kEps, y + kEps);
    for (const Cell grown : std::array<Cell, 3>{{{0, 0}, {1, 0}, {0, 1}}})
      if (!cells.is_open(x + grown.x, y + grown.y) &&
          meets(s, low, Point(x + 1 + grown.x - kEps, y + 1 + grown.y - kEps)))
        fault = "enters the closed cell " + text_of(x, y);
  });
  return fault;
}

Segment in_cells(const PlainCells& cells, const Point& a_m, const Point& b_m) {
  return {(a_m - cells.origin_m) / cells.cell_m, (b_m - cells.origin_m) / cells.cell_m};
}

std::string fault_of_ends(const PlainCells& cells, std::span<const Point> path, const Point& from, const Point& to) {
  if (path.empty()) return "the path is empty";
  for (const Point& p : path)
    if (!p.allFinite()) return "a point is not finite";
  // Longer than the tolerance of the rest: ends may be given in decimals.
  const double near_m = 1e-3 * cells.cell_m;
  if ((path.front() - from).norm() > near_m) return "begins at " + text_of(path.front().x(), path.front().y());
  if ((path.back() - to).norm() > near_m) return "ends at " + text_of(path.back().x(), path.back().y());
  return "";
}

}  // namespace

std::string fault_of_point_path(const PlainCells& cells, std::span<const Point> path, const Point& from,
                                const Point& to) {
  std::string fault = fault_of_ends(cells, path, from, to);
  for (std::size_t i = 0; fault.empty() && i < path.size(); ++i)
    fault = fault_of_point_segment(cells, in_cells(cells, path[i], path[std::min(i + 1, path.size() - 1)]));
  return fault;
}

std::string fault_of_disc_path(const PlainCells& cells, std::span<const Point> path, const Point& from, const Point& to,
                               double radius_m) {
  std::string fault = fault_of_ends(cells, path, from, to);
  if (!fault.empty()) return fault;
  const double near_m = distance_to_closed_m(cells, path, radius_m);
  if (near_m < radius_m - kEps * cells.cell_m) fault = "comes within " + std::to_string(near_m) + " m of a closed cell";
  return fault;
}

double distance_to_closed_m(const PlainCells& cells, std::span<const Point> path, double reach_m) {
  double least = reach_m / cells.cell_m;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Segment s = in_cells(cells, path[i], path[std::min(i + 1, path.size() - 1)]);
    each_cell_near(s, least, [&](int x, int y) {
      if (!cells.is_open(x, y)) least = std::min(least, distance_to_cell(s, x, y));
    });
  }
  return least * cells.cell_m;
}

double length_of_m(std::span<const Point> path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

}  // namespace cairn
