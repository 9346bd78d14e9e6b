#include "maps/grid/beam_cells.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace cairn {
namespace {

// In cells: more than all rounding here, less than matters. Spans may be too wide, never too narrow.
constexpr double kMargin_cells = 1e-6;

struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  void cut(double from, double to) {
    low = std::max(low, from);
    high = std::min(high, to);
  }
};

// All below in cells, relative to the apex.

// x of the points of the row at height y inside the disc.
void cut_to_disc(Interval& x, double y, double radius) {
  const double half = std::sqrt(std::max(0.0, radius * radius - y * y));
  x.cut(-half, half);
}

// A line through the apex: the points p with cross(direction, p) >= 0 are to its left.
struct Edge {
  Point direction;
  double dx_per_dy = 0.0;

  explicit Edge(const Point& d) : direction(d), dx_per_dy(d.y() != 0.0 ? d.x() / d.y() : 0.0) {}
};

// x of the points of the row at height y to the left of the edge.
void cut_to_left_of(Interval& x, double y, const Edge& edge) {
  if (edge.direction.y() > 0.0) x.high = std::min(x.high, edge.dx_per_dy * y);
  if (edge.direction.y() < 0.0) x.low = std::max(x.low, edge.dx_per_dy * y);
}

Point direction_of(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

// Lowest and highest y of the sector: its apex, its two corners, and the disc's poles it holds.
Interval rows_of(const Beam& beam, const Point& right, const Point& left, double radius) {
  Interval y{radius * std::min({0.0, right.y(), left.y()}), radius * std::max({0.0, right.y(), left.y()})};
  const double half_cosine = std::cos(beam.half_beam_rad);
  const double sine = std::sin(beam.T_map_sensor.theta_rad);  // cosine of the angle between the axis and the upper pole
  if (sine >= half_cosine) y.high = radius;
  if (-sine >= half_cosine) y.low = -radius;
  return y;
}

int floor_of(double cells) {
  const int whole = static_cast<int>(cells);  // std::floor is a call on machines of the oldest kind
  return whole - (static_cast<double>(whole) > cells ? 1 : 0);
}

void spans_of_cone(const Beam& beam, const Point& apex, double reach, std::vector<CellSpan>& spans) {
  const double axis = beam.T_map_sensor.theta_rad;
  const Point right = direction_of(axis - beam.half_beam_rad);
  const Point left = direction_of(axis + beam.half_beam_rad);
  const Interval rows = rows_of(beam, right, left, reach);
  const Edge right_edge(right);
  const Edge left_edge(-left);
  const bool convex = beam.half_beam_rad <= 0.5 * std::numbers::pi;

  const int y_last = floor_of(apex.y() + rows.high - 0.5 + kMargin_cells);
  for (int cell_y = floor_of(apex.y() + rows.low + 0.5 - kMargin_cells); cell_y <= y_last; ++cell_y) {
    const double y = cell_y + 0.5 - apex.y();
    Interval x;
    cut_to_disc(x, y, reach + kMargin_cells);
    if (convex) {
      cut_to_left_of(x, y, right_edge);
      cut_to_left_of(x, y, left_edge);
    }
    const int first = floor_of(apex.x() + x.low + 0.5 - kMargin_cells);
    const int end = floor_of(apex.x() + x.high + 0.5 + kMargin_cells);
    if (first < end) spans.push_back({cell_y, first, end});
  }
}

void spans_of_ray(const Beam& beam, const Point& apex, double reach, std::vector<CellSpan>& spans) {
  const Point offset = reach * beam.T_map_sensor.direction();
  const Point tip = apex + offset;
  const int y_last = floor_of(std::max(apex.y(), tip.y()));
  const Interval whole{std::min(apex.x(), tip.x()), std::max(apex.x(), tip.x())};
  const bool is_level = offset.y() == 0.0;
  const double dx_per_dy = is_level ? 0.0 : offset.x() / offset.y();
  const auto x_at = [&](int y) { return apex.x() + (y - apex.y()) * dx_per_dy; };
  const int y_first = floor_of(std::min(apex.y(), tip.y()));
  double x_below = x_at(y_first);
  for (int y = y_first; y <= y_last; ++y) {
    Interval x = whole;
    const double x_above = x_at(y + 1);
    if (!is_level) x.cut(std::min(x_below, x_above), std::max(x_below, x_above));
    x_below = x_above;
    if (x.low <= x.high) spans.push_back({y, floor_of(x.low), floor_of(x.high) + 1});
  }
}

}  // namespace

void spans_over(const Beam& beam, double cell_m, std::vector<CellSpan>& spans) {
  spans.clear();
  if (!(beam.reach_m > 0.0)) return;
  const Point apex = beam.T_map_sensor.position() / cell_m;
  const double reach = beam.reach_m / cell_m;
  if (beam.half_beam_rad > 0.0)
    spans_of_cone(beam, apex, reach, spans);
  else
    spans_of_ray(beam, apex, reach, spans);
}

}  // namespace cairn
