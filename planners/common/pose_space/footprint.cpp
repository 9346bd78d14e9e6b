#include "planners/common/pose_space/footprint.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kStripsPerWidth = 2.0;  // along the longer side of the cover; each strip gets a disc
constexpr double kMaxStrips = 8.0;
constexpr double kFurthest_m = 1000.0;  // work grows with size: beyond it something else is wrong

// Shared points count, also of segments that lie on one line.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto side = [](const Point& from, const Point& to, const Point& p) { return cross(to - from, p - from); };
  if (distance_to_segment_m(a, c, d) == 0.0 || distance_to_segment_m(b, c, d) == 0.0 ||
      distance_to_segment_m(c, a, b) == 0.0 || distance_to_segment_m(d, a, b) == 0.0)
    return true;
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

double doubled_area(const std::vector<Point>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) sum += cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

void check_simple(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  if (n < 3) throw std::invalid_argument("a footprint needs three corners or more, not " + std::to_string(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::string corner = "corner " + std::to_string(i + 1) + " of the footprint is ";
    if (!corners[i].allFinite()) throw std::invalid_argument(corner + "not finite");
    if (corners[i].norm() > kFurthest_m) throw std::invalid_argument(corner + "further than a kilometre away");
  }
  const auto fail = [](std::size_t i, std::size_t k) {
    throw std::invalid_argument("sides " + std::to_string(i + 1) + " and " + std::to_string(k + 1) +
                                " of the footprint meet");
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % n];
    const Point& c = corners[(i + 2) % n];
    // Neighbours share one corner and nothing else.
    if (a == b || (cross(b - a, c - b) == 0.0 && (b - a).dot(c - b) < 0.0)) fail(i, (i + 1) % n);
    for (std::size_t k = i + 2; k < n; ++k)
      if ((k + 1) % n != i && segments_meet(a, b, corners[k], corners[(k + 1) % n])) fail(i, k);
  }
}

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
    throw std::invalid_argument("a footprint's radius must be 0 or more, not " + std::to_string(radius_m));
  Footprint footprint;
  footprint.inscribed_m_ = footprint.circumscribed_m_ = radius_m;
  footprint.cover_ = {{{0.0, 0.0}, radius_m}};
  return footprint;
}

Footprint Footprint::polygon(std::vector<Point> corners_m) {
  check_simple(corners_m);
  if (doubled_area(corners_m) == 0.0) throw std::invalid_argument("the footprint has no area");
  if (doubled_area(corners_m) < 0.0) std::reverse(corners_m.begin(), corners_m.end());
  Footprint footprint;
  footprint.inscribed_m_ = holds(corners_m, {0.0, 0.0}) ? kInfinite : 0.0;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Point& next = corners_m[(i + 1) % corners_m.size()];
    footprint.inscribed_m_ = std::min(footprint.inscribed_m_, distance_to_segment_m({0.0, 0.0}, corners_m[i], next));
    footprint.circumscribed_m_ = std::max(footprint.circumscribed_m_, corners_m[i].norm());
  }
  footprint.cover_ = cover_of(corners_m);
  footprint.corners_m_ = std::move(corners_m);
  return footprint;
}

bool holds(std::span<const Point> corners, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[i + 1 < corners.size() ? i + 1 : 0];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) inside = !inside;
  }
  return inside;
}

bool is_near(std::span<const Point> corners, double reach_m, const Lattice& lattice, Cell cell) {
  const Point centre = lattice.centre_of(cell);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (distance_to_square_m(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0], centre, lattice.cell_m) < reach_m)
      return true;
  return holds(corners, centre);
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
