// Straight pieces, and the paths and polygons that are made of them.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

// Where on the segment the point of it nearest to p lies: 0 at a, 1 at b. A segment may be a single point.
[[nodiscard]] inline double share_along(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = along.squaredNorm();
  return squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
}
[[nodiscard]] inline Point nearest_on_segment(const Point& p, const Point& a, const Point& b) {
  return a + share_along(p, a, b) * (b - a);
}
[[nodiscard]] inline double distance_to_segment_m(const Point& p, const Point& a, const Point& b) {
  return (nearest_on_segment(p, a, b) - p).norm();
}

[[nodiscard]] inline double length_of(std::span<const Point> path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}
[[nodiscard]] inline double length_of(std::span<const Pose2> path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i].position() - path[i - 1].position()).norm();
  return length_m;
}

// Of a closed polygon's outline, whichever way round it goes.
[[nodiscard]] double distance_to_outline_m(std::span<const Point> polygon, const Point& p);
[[nodiscard]] bool is_inside(std::span<const Point> polygon, const Point& p);

}  // namespace cairn
