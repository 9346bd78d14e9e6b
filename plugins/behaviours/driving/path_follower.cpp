#include "plugins/behaviours/driving/path_follower.hpp"

#include <algorithm>
#include <limits>

namespace cairn::behaviours {
namespace {

constexpr double kTurnGain_per_s = 2.0;
constexpr double kAligned_rad = radians(12.0);  // turning in place ends here
constexpr double kAimed_rad = radians(2.0);
constexpr double kCrawl_mps = 0.03;
// The nearest point is looked for this far around the last one, so that a lap which passes its own
// start again is not cut short.
constexpr double kBack_m = 0.1;
constexpr double kAhead_m = 0.6;

struct Nearest {
  double along_m = 0.0;
  double distance_m = std::numeric_limits<double>::infinity();
};

Nearest nearest_on(const std::vector<Point>& path, const Point& p, double from_m, double to_m) {
  Nearest best;
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

double speed_towards_end(double left_m, const FollowLimits& limits) {
  return std::min(limits.speed_mps, std::max(kCrawl_mps, std::sqrt(2.0 * limits.slow_down_mps2 * left_m)));
}

Twist pursuit(double error_rad, double aim_m, double v_mps, const FollowLimits& limits) {
  // The arc that starts along the heading and passes the aim.
  double curvature = 2.0 * std::sin(error_rad) / std::max(aim_m, 0.05);
  if (limits.min_turning_radius_m > 0.0) {
    if (std::cos(error_rad) < 0.0) curvature = std::copysign(1.0 / limits.min_turning_radius_m, error_rad);
    const double most = 1.0 / limits.min_turning_radius_m;
    curvature = std::clamp(curvature, -most, most);
  }
  const double w = v_mps * curvature;
  if (std::abs(w) <= limits.max_w_radps) return {v_mps, w};
  return {limits.max_w_radps / std::abs(curvature), std::copysign(limits.max_w_radps, w)};
}

}  // namespace

FollowLimits follow_limits(const RobotModel& robot, double speed_mps) {
  FollowLimits limits;
  limits.speed_mps = std::min(speed_mps, robot.max_v_mps);
  // Turns faster than the sonars' round leave blind spots in the map.
  limits.max_w_radps = std::min(radians(50.0), robot.max_w_radps);
  limits.slow_down_mps2 = 0.5 * robot.max_acceleration_mps2;
  limits.lookahead_m = std::clamp(1.2 * limits.speed_mps, 0.2, 0.5);
  if (robot.kinematics == Kinematics::car) limits.min_turning_radius_m = robot.min_turning_radius_m;
  return limits;
}

FollowStep follow(const Pose2& T_map_robot, const std::vector<Point>& path, const FollowState& state,
                  const FollowLimits& limits) {
  FollowStep step;
  step.state = state;
  step.arrived = true;
  if (path.empty()) return step;

  const double length_m = length_of(path);
  const Point position = T_map_robot.position();
  const Nearest nearest = nearest_on(path, position, state.along_m - kBack_m, state.along_m + kAhead_m);
  step.state.along_m = std::max(state.along_m, nearest.along_m);
  step.left_m = length_m - step.state.along_m;
  step.off_path_m = nearest.distance_m;
  const double to_end_m = (path.back() - position).norm();
  if (step.left_m <= limits.lookahead_m && to_end_m <= limits.arrive_m) return step;

  step.arrived = false;
  const Point aim = point_along(path, step.state.along_m + limits.lookahead_m);
  const double error_rad = heading_error(T_map_robot, aim);
  const bool can_turn = limits.min_turning_radius_m <= 0.0;
  step.state.turning = can_turn && std::abs(error_rad) > (state.turning ? kAligned_rad : limits.turn_in_place_rad);
  if (step.state.turning) {
    step.wanted = turn_by(error_rad, limits.max_w_radps);
  } else {
    const double v_mps = speed_towards_end(std::max(step.left_m, to_end_m), limits);
    step.wanted = pursuit(error_rad, (aim - position).norm(), v_mps, limits);
  }
  return step;
}

Twist turn_by(double heading_error_rad, double max_w_radps) {
  if (std::abs(heading_error_rad) <= kAimed_rad) return {};
  return {0.0, std::clamp(kTurnGain_per_s * heading_error_rad, -max_w_radps, max_w_radps)};
}

double heading_error(const Pose2& T_map_robot, const Point& target_map) {
  const Point to_target = target_map - T_map_robot.position();
  if (to_target.norm() < 1e-9) return 0.0;
  return wrap_angle(std::atan2(to_target.y(), to_target.x()) - T_map_robot.theta_rad);
}

Point point_along(const std::vector<Point>& path, double along_m) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double leg_m = (path[i + 1] - path[i]).norm();
    if (along_m < leg_m) return path[i] + (path[i + 1] - path[i]) * (std::max(0.0, along_m) / leg_m);
    along_m -= leg_m;
  }
  return path.back();
}

}  // namespace cairn::behaviours
