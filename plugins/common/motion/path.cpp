#include "plugins/common/motion/path.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::motion {

Point point_along(std::span<const Point> path, double along_m) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double leg_m = (path[i + 1] - path[i]).norm();
    if (along_m < leg_m) return path[i] + (path[i + 1] - path[i]) * (std::max(0.0, along_m) / leg_m);
    along_m -= leg_m;
  }
  return path.back();
}

NearestOnPath nearest_on(std::span<const Point> path, const Point& p, double from_m, double to_m) {
  NearestOnPath best;
  double begin_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point leg = path[i + 1] - path[i];
    const double leg_m = leg.norm();
    const double low_m = std::max(0.0, from_m - begin_m);
    const double high_m = std::min(leg_m, to_m - begin_m);
    if (leg_m > 0.0 && low_m <= high_m) {
      const double t_m = std::clamp((p - path[i]).dot(leg) / leg_m, low_m, high_m);
      const double distance_m = (path[i] + leg * (t_m / leg_m) - p).norm();
      if (distance_m < best.distance_m) best = {begin_m + t_m, distance_m};
    }
    begin_m += leg_m;
  }
  if (best.distance_m == std::numeric_limits<double>::infinity()) best = {begin_m, (path.back() - p).norm()};
  return best;
}

double heading_error(const Pose2& T_map_robot, const Point& target_map) {
  const Point to_target = target_map - T_map_robot.position();
  if (to_target.norm() < 1e-9) return 0.0;
  return wrap_angle(std::atan2(to_target.y(), to_target.x()) - T_map_robot.theta_rad);
}

}  // namespace cairn::motion
