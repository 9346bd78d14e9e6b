#include "maps/geometry/segments.hpp"

#include <limits>

namespace cairn {

double distance_to_outline_m(std::span<const Point> polygon, const Point& p) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    nearest_m = std::min(nearest_m, distance_to_segment_m(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  return nearest_m;
}

bool is_inside(std::span<const Point> polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Point& a = polygon[i];
    const Point& b = polygon[k];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

}  // namespace cairn
