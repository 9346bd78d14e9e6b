#include "maps/landmarks/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cairn {
namespace {

constexpr double kArcError_m = 0.001;
constexpr double kLargestTurn_rad = std::numbers::pi / 12.0;

// Adds the points between the ends of an arc.
void add_arc(std::vector<Point>& points, const Point& from, const Point& to, double bulge) {
  const double angle_rad = 4.0 * std::atan(bulge);
  const Point chord = to - from;
  // The centre lies to the left of the way for an anticlockwise arc of less than half a circle.
  const double centre_left = (1.0 - bulge * bulge) / (4.0 * bulge);
  const Point centre = from + 0.5 * chord + centre_left * Point(-chord.y(), chord.x());
  const double radius_m = (from - centre).norm();
  const double fine_rad = 2.0 * std::acos(1.0 - std::min(1.0, kArcError_m / radius_m));
  const double step_rad = std::min(kLargestTurn_rad, fine_rad);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(angle_rad) / step_rad)));
  for (int i = 1; i < steps; ++i) {
    const Pose2 turn{0.0, 0.0, angle_rad * i / steps};
    points.push_back(centre + turn * Point(from - centre));
  }
}

}  // namespace

std::vector<Point> with_arcs(std::span<const Point> corners_m, std::span<const double> bulges) {
  if (bulges.size() != corners_m.size()) {
    throw std::invalid_argument(
        fmt::format("needs one number for each corner's side, {}, found {}", corners_m.size(), bulges.size()));
  }
  std::vector<Point> points;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    if (!std::isfinite(bulges[i])) throw std::invalid_argument(fmt::format("number {} is not finite", i));
    points.push_back(corners_m[i]);
    const Point& to = corners_m[(i + 1) % corners_m.size()];
    if (bulges[i] != 0.0 && to != corners_m[i]) add_arc(points, corners_m[i], to, bulges[i]);
  }
  return points;
}

}  // namespace cairn
