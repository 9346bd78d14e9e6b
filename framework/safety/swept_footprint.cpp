#include "framework/safety/swept_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

// What is within the margin already may be passed along: nearer by less than this on the first metres of the arc.
constexpr double kSoon_m = 0.05;
constexpr double kNearer_m = 0.01;
constexpr double kStraight_per_m = 1e-7;  // curvature
constexpr double kRounding_m = 1e-4;

}  // namespace

double distance_to_footprint_m(const RobotModel& robot, const Point& p) {
  if (robot.polygon_m.empty()) return p.norm() - robot.radius_m;
  const double nearest_m = distance_to_outline_m(robot.polygon_m, p);
  return is_inside(robot.polygon_m, p) ? -nearest_m : nearest_m;
}

double reach_of_m(const RobotModel& robot) {
  if (robot.polygon_m.empty()) return robot.radius_m;
  double reach_m = 0.0;
  for (const Point& corner : robot.polygon_m) reach_m = std::max(reach_m, corner.norm());
  return reach_m;
}

double sweep_speed_mps(const RobotModel& robot, const Twist& twist) {
  return std::abs(twist.v_mps) + (robot.polygon_m.empty() ? 0.0 : reach_of_m(robot) * std::abs(twist.w_radps));
}

double free_sweep_m(const RobotModel& robot, const Twist& twist, const Point& p, double margin_m, double at_most_m,
                    double step_m) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double speed_mps = sweep_speed_mps(robot, twist);
  if (speed_mps <= 0.0 || p.norm() - reach_of_m(robot) - margin_m > at_most_m) return kNever;
  // The centre's path is a circle or a line: what is farther from all of it than the footprint reaches is never met.
  const bool is_straight = std::abs(twist.w_radps) < kStraight_per_m * std::abs(twist.v_mps);
  const double radius_m = is_straight ? 0.0 : twist.v_mps / twist.w_radps;
  const double off_m =
      is_straight ? std::abs(p.y()) : std::abs(std::hypot(p.x(), p.y() - radius_m) - std::abs(radius_m));
  if (off_m > reach_of_m(robot) + margin_m + kRounding_m) return kNever;
  const auto gap_m = [&](double way_m) {
    return distance_to_footprint_m(robot, inverse(pose_after(twist, way_m / speed_mps)) * p) - margin_m;
  };
  const double gap_now_m = gap_m(0.0);
  if (gap_now_m < 0.0) return gap_m(kSoon_m) < gap_now_m - kNearer_m ? 0.0 : kNever;
  // No step goes farther than the gap, so that none jumps over the point's neighbourhood.
  for (double way_m = 0.0; way_m <= at_most_m;) {
    const double gap = gap_m(way_m);
    if (gap < 0.0) return std::max(0.0, way_m - step_m);
    way_m += std::max(gap, step_m);
  }
  return kNever;
}

}  // namespace cairn
