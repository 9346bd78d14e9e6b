#include "maps/geometry/contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

// Twice the signed area of the triangle a, b, c: positive when c lies left of a -> b.
double cross(const Point& a, const Point& b, const Point& c) {
  return cairn::cross(b - a, c - a);
}

std::string text_of(const Point& p) {
  return fmt::format("({:f}, {:f})", p.x(), p.y());
}

// Whether p, known to be in line with a and b, lies between them.
bool is_within(const Point& a, const Point& b, const Point& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double abc = cross(a, b, c);
  const double abd = cross(a, b, d);
  const double cda = cross(c, d, a);
  const double cdb = cross(c, d, b);
  if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 && cda != 0 && cdb != 0) return true;
  return (abc == 0 && is_within(a, b, c)) || (abd == 0 && is_within(a, b, d)) || (cda == 0 && is_within(c, d, a)) ||
         (cdb == 0 && is_within(c, d, b));
}

void require_finite_and_distinct(const std::vector<Point>& corners) {
  if (corners.size() < 3) {
    throw std::invalid_argument(fmt::format("a polygon needs at least 3 corners, this one has {}", corners.size()));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!corners[i].allFinite()) {
      throw std::invalid_argument(fmt::format("corner {} of the polygon is not finite", i));
    }
    const std::size_t next = (i + 1) % corners.size();
    if (corners[i] == corners[next]) {
      throw std::invalid_argument(fmt::format(
          "corner {} of the polygon repeats corner {} {}; name each corner once, the last one joins the first", next, i,
          text_of(corners[i])));
    }
  }
}

void require_simple(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % n];
    // The next side shares corner b; it crosses only by folding straight back.
    const Point& c = corners[(i + 2) % n];
    const bool folds_back = cross(a, b, c) == 0 && (b - a).dot(c - b) < 0;
    if (folds_back) throw std::invalid_argument("the polygon folds back on itself at " + text_of(b));
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (segments_meet(a, b, corners[j], corners[(j + 1) % n])) {
        throw std::invalid_argument(
            fmt::format("the polygon crosses itself: its sides from corner {} and from corner {} meet", i, j));
      }
    }
  }
}

struct AreaMoments {
  double area = 0.0;  // signed
  Point centroid{0.0, 0.0};
};

// About the first corner, so that shapes far from the origin keep their digits.
AreaMoments moments_of(const std::vector<Point>& corners) {
  const Point& origin = corners.front();
  double twice_area = 0.0;
  Point sum{0.0, 0.0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const double piece = cross(origin, corners[i], corners[i + 1]);
    twice_area += piece;
    sum += piece * (corners[i] - origin + corners[i + 1] - origin) / 3.0;
  }
  if (twice_area == 0.0) return {0.0, origin};
  return {twice_area / 2.0, origin + sum / twice_area};
}

Point centroid_of(const std::vector<std::vector<Point>>& polygons) {
  // To the bit what the polygon alone has.
  if (polygons.size() == 1) return moments_of(polygons.front()).centroid;
  double area = 0.0;
  Point sum{0.0, 0.0};
  for (const std::vector<Point>& corners : polygons) {
    const AreaMoments moments = moments_of(corners);
    area += moments.area;
    sum += moments.area * moments.centroid;
  }
  return sum / area;
}

double squared_extent(const std::vector<Point>& corners) {
  double extent = 0.0;
  for (const Point& p : corners) extent = std::max(extent, (p - corners.front()).squaredNorm());
  return extent;
}

bool outlines_meet(const std::vector<Point>& p, const std::vector<Point>& q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) {
      if (segments_meet(p[i], p[(i + 1) % p.size()], q[j], q[(j + 1) % q.size()])) return true;
    }
  }
  return false;
}

void require_apart(const std::vector<std::vector<Point>>& polygons) {
  for (std::size_t later = 1; later < polygons.size(); ++later) {
    for (std::size_t i = 0; i < later; ++i) {
      const std::vector<Point>& p = polygons[i];
      const std::vector<Point>& q = polygons[later];
      if (!outlines_meet(p, q) && !is_inside(p, q.front()) && !is_inside(q, p.front())) continue;
      throw std::invalid_argument(fmt::format(
          "part {} meets part {}; parts must stand apart, draw what touches as one outline", later + 1, i + 1));
    }
  }
}

// As a simple anticlockwise polygon. Throws std::invalid_argument.
std::vector<Point> checked(std::vector<Point> corners) {
  require_finite_and_distinct(corners);
  const double area = moments_of(corners).area;
  // A bow tie may have no net area too; what is wrong with it is the crossing.
  const bool is_flat = std::abs(area) <= 1e-9 * squared_extent(corners);
  if (!is_flat || corners.size() > 3) require_simple(corners);
  if (is_flat) throw std::invalid_argument("the polygon has no area: its corners lie in one line");
  if (area < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::vector<Point> regular_polygon(double radius_m, int corners) {
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = i * 2.0 * std::numbers::pi / corners;
    points.push_back(radius_m * Point(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return points;
}

}  // namespace

Contour Contour::circle(double diameter_m) {
  if (!std::isfinite(diameter_m) || diameter_m <= 0.0) {
    throw std::invalid_argument(fmt::format("a circle needs a diameter above 0 m, this one has {:f}", diameter_m));
  }
  Contour contour;
  contour.circle_diameter_m = diameter_m;
  return contour;
}

Contour Contour::polygon(std::vector<Point> corners_m) {
  return parts({std::move(corners_m)});
}

Contour Contour::polygon_in_place(std::vector<Point> corners_m) {
  return parts_in_place({std::move(corners_m)});
}

Contour Contour::parts(std::vector<std::vector<Point>> polygons_m) {
  Contour contour = parts_in_place(std::move(polygons_m));
  const Point centroid = contour.centroid_m();
  for (std::vector<Point>& corners : contour.polygons_m) {
    for (Point& p : corners) p -= centroid;
  }
  return contour;
}

Contour Contour::parts_in_place(std::vector<std::vector<Point>> polygons_m) {
  if (polygons_m.empty()) throw std::invalid_argument("an outline needs at least one part");
  Contour contour;
  for (std::size_t i = 0; i < polygons_m.size(); ++i) {
    try {
      contour.polygons_m.push_back(checked(std::move(polygons_m[i])));
    } catch (const std::invalid_argument& error) {
      if (polygons_m.size() == 1) throw;
      throw std::invalid_argument(fmt::format("part {}: {}", i + 1, error.what()));
    }
  }
  require_apart(contour.polygons_m);
  return contour;
}

Point Contour::centroid_m() const {
  return is_circle() ? Point{0.0, 0.0} : centroid_of(polygons_m);
}

std::vector<std::vector<Point>> Contour::outlines_m(int circle_corners) const {
  if (!is_circle()) return polygons_m;
  return {regular_polygon(circle_diameter_m / 2.0, circle_corners)};
}

double Contour::inner_diameter_m() const {
  if (is_circle()) return circle_diameter_m;
  return std::max(0.0, -2.0 * signed_distance({0.0, 0.0}));
}

double Contour::outer_diameter_m() const {
  if (is_circle()) return circle_diameter_m;
  double radius_m = 0.0;
  for (const std::vector<Point>& corners : polygons_m) {
    for (const Point& p : corners) radius_m = std::max(radius_m, p.norm());
  }
  return 2.0 * radius_m;
}

Contour Contour::scaled(double ratio) const {
  Contour contour = *this;
  contour.circle_diameter_m *= ratio;
  for (std::vector<Point>& corners : contour.polygons_m)
    for (Point& corner : corners) corner *= ratio;
  return contour;
}

double Contour::signed_distance(const Point& p) const {
  if (is_circle()) return p.norm() - 0.5 * circle_diameter_m;
  // The parts stand apart, so that a point is inside of at most one.
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<Point>& corners : polygons_m) {
    const double distance = distance_to_outline_m(corners, p);
    nearest = std::min(nearest, is_inside(corners, p) ? -distance : distance);
  }
  return nearest;
}

}  // namespace cairn
