#include "planners/common/pose_space/footprint.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "maps/geometry/contour.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kStripsPerWidth = 2.0;  // along the longer side of the cover; each strip gets a disc
constexpr double kMaxStrips = 8.0;
constexpr double kFurthest_m = 1000.0;  // work grows with size: beyond it something else is wrong

// The smallest upright box round the part of the outline between two values of one axis.
Footprint::Disc disc_round_strip(const std::vector<Point>& corners, int axis, double low, double high) {
  const int other = 1 - axis;
  double least = kInfinite;
  double most = -kInfinite;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    if (std::max(a[axis], b[axis]) < low || std::min(a[axis], b[axis]) > high) continue;
    const double step = b[axis] - a[axis];
    for (const double t : {step == 0.0 ? 0.0 : (low - a[axis]) / step, step == 0.0 ? 1.0 : (high - a[axis]) / step}) {
      const double at = a[other] + std::clamp(t, 0.0, 1.0) * (b[other] - a[other]);
      least = std::min(least, at);
      most = std::max(most, at);
    }
  }
  Footprint::Disc disc;
  disc.centre[axis] = 0.5 * (low + high);
  disc.centre[other] = 0.5 * (least + most);
  disc.radius_m = 0.5 * std::hypot(high - low, most - least);
  return disc;
}

std::vector<Footprint::Disc> cover_of(const std::vector<Point>& corners) {
  Point low = corners[0];
  Point high = corners[0];
  for (const Point& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Point size = high - low;
  const int axis = size.x() >= size.y() ? 0 : 1;
  const double strips = std::min(std::ceil(kStripsPerWidth * size[axis] / size[1 - axis]), kMaxStrips);
  std::vector<Footprint::Disc> cover;
  for (double k = 0.0; k < strips; k += 1.0)
    cover.push_back(disc_round_strip(corners, axis, low[axis] + size[axis] * (k / strips),
                                     low[axis] + size[axis] * ((k + 1.0) / strips)));
  return cover;
}

}  // namespace

Footprint Footprint::disc(double radius_m) {
  if (!std::isfinite(radius_m) || radius_m < 0.0)
    throw std::invalid_argument(fmt::format("a footprint's radius must be 0 or more, not {:f}", radius_m));
  Footprint footprint;
  footprint.inscribed_m_ = footprint.circumscribed_m_ = radius_m;
  footprint.cover_ = {{{0.0, 0.0}, radius_m}};
  return footprint;
}

Footprint Footprint::polygon(std::vector<Point> corners_m) {
  const Contour outline = Contour::polygon_in_place(std::move(corners_m));
  Footprint footprint;
  footprint.corners_m_ = outline.polygons_m.front();
  footprint.inscribed_m_ = 0.5 * outline.inner_diameter_m();
  footprint.circumscribed_m_ = 0.5 * outline.outer_diameter_m();
  if (footprint.circumscribed_m_ > kFurthest_m)
    throw std::invalid_argument("the footprint reaches further than a kilometre from its origin");
  footprint.cover_ = cover_of(footprint.corners_m_);
  return footprint;
}

bool is_near(std::span<const Point> corners, double reach_m, const Lattice& lattice, Cell cell) {
  const Point centre = lattice.centre_of(cell);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (distance_to_square_m(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0], centre, lattice.cell_m) < reach_m)
      return true;
  return is_inside(corners, centre);
}

Span span_between(std::span<const Point> corners, double y_low, double y_high) {
  Span span{kInfinite, -kInfinite};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[i + 1 < corners.size() ? i + 1 : 0];
    const auto [low, high] = std::minmax(a.y(), b.y());
    if (high < y_low || low > y_high) continue;
    double x_a = a.x();
    double x_b = b.x();
    if (low < y_low || high > y_high) {  // only a part of this side lies between
      const double slope = (b.x() - a.x()) / (b.y() - a.y());
      x_b = a.x() + (std::clamp(b.y(), y_low, y_high) - a.y()) * slope;
      x_a = a.x() + (std::clamp(a.y(), y_low, y_high) - a.y()) * slope;
    }
    span.low = std::min({span.low, x_a, x_b});
    span.high = std::max({span.high, x_a, x_b});
  }
  return span;
}

}  // namespace cairn
