// Paths as lists of points: lengths, points along them, and where the robot is on them.
#pragma once

#include <limits>
#include <span>

#include "maps/geometry/pose.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn::motion {

// The point this far along the path; its ends beyond them. The path must not be empty.
[[nodiscard]] Point point_along(std::span<const Point> path, double along_m);

struct NearestOnPath {
  double along_m = 0.0;
  double distance_m = std::numeric_limits<double>::infinity();
};
// The point of the path nearest to p, looked for from from_m to to_m along it; the path's end when it has no such part.
// The path must not be empty.
[[nodiscard]] NearestOnPath nearest_on(std::span<const Point> path, const Point& p, double from_m, double to_m);

// By how much the robot must turn to look at the target, anticlockwise positive.
[[nodiscard]] double heading_error(const Pose2& T_map_robot, const Point& target_map);

}  // namespace cairn::motion
