#include "plugins/pursuit_dwa/path_follower.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/common/motion/path.hpp"

namespace cairn::pursuit_dwa {
namespace {

constexpr double kMinAim_m = 0.05;  // no arc is tighter for a nearer aim

double speed_towards_end(double left_m, const FollowLimits& limits) {
  return std::min(limits.speed_mps, std::max(limits.how.crawl_mps, std::sqrt(2.0 * limits.slow_down_mps2 * left_m)));
}

Twist pursuit(double error_rad, double aim_m, double v_mps, const FollowLimits& limits) {
  // The arc that starts along the heading and passes the aim.
  double curvature = 2.0 * std::sin(error_rad) / std::max(aim_m, kMinAim_m);
  if (limits.min_turning_radius_m > 0.0) {
    if (std::cos(error_rad) < 0.0) curvature = std::copysign(1.0 / limits.min_turning_radius_m, error_rad);
    const double tightest = 1.0 / limits.min_turning_radius_m;
    curvature = std::clamp(curvature, -tightest, tightest);
  }
  const double w = v_mps * curvature;
  if (std::abs(w) <= limits.max_w_radps) return {v_mps, w};
  return {limits.max_w_radps / std::abs(curvature), std::copysign(limits.max_w_radps, w)};
}

}  // namespace

void FollowSettings::describe(Fields<FollowSettings>& fields) {
  using C = FollowSettings;
  fields.number("lookahead_s", &C::lookahead_s, {0.1, 10.0}, "s",
                "the robot aims at the point of the path that it reaches in this time at its top speed");
  fields.number("lookahead_min_m", &C::lookahead_min_m, {0.01, 10.0}, "m", "but no nearer than this");
  fields.number("lookahead_max_m", &C::lookahead_max_m, {0.01, 10.0}, "m", "and no further than this");
  fields.number("slow_down_ratio", &C::slow_down_ratio, {0.01, 1.0}, "",
                "share of the robot's deceleration with which it slows down for the end of the path");
  fields.number("crawl_mps", &C::crawl_mps, {0.001, 1.0}, "m/s", "it comes to the end of the path no slower than this");
  fields.angle("turn_in_place_deg", &C::turn_in_place_rad, {1.0, 180.0},
               "with a larger heading error the robot stops and turns in place; a car never does");
  fields.angle("aligned_deg", &C::aligned_rad, {0.5, 180.0}, "a turn in place ends at this heading error");
  fields.number("search_back_m", &C::search_back_m, {0.0, 10.0}, "m",
                "the nearest point of the path is looked for from this far behind the last one");
  fields.number("search_ahead_m", &C::search_ahead_m, {0.01, 100.0}, "m",
                "to this far ahead of it, so that a path that passes its own start again is not cut short");
  fields.group("turn", &C::turn, "how it turns in place");
}

FollowLimits follow_limits(const RobotModel& robot, double speed_mps, const FollowSettings& how) {
  FollowLimits limits;
  limits.how = how;
  limits.speed_mps = std::min(speed_mps, robot.max_v_mps);
  limits.max_w_radps = motion::max_turn_radps(robot, how.turn);
  limits.slow_down_mps2 = how.slow_down_ratio * robot.max_acceleration_mps2;
  limits.lookahead_m = std::max(how.lookahead_min_m, std::min(how.lookahead_s * limits.speed_mps, how.lookahead_max_m));
  if (robot.kinematics == Kinematics::car) limits.min_turning_radius_m = robot.min_turning_radius_m;
  return limits;
}

FollowStep follow(const Pose2& T_map_robot, std::span<const Point> path, const PathProgress& state,
                  const FollowLimits& limits) {
  FollowStep step;
  step.state = state;
  step.arrived = true;
  if (path.empty()) return step;

  const double length_m = length_of(path);
  const Point position = T_map_robot.position();
  const motion::NearestOnPath nearest = motion::nearest_on(path, position, state.along_m - limits.how.search_back_m,
                                                           state.along_m + limits.how.search_ahead_m);
  step.state.along_m = std::max(state.along_m, nearest.along_m);
  step.left_m = length_m - step.state.along_m;
  step.off_path_m = nearest.distance_m;
  const double to_end_m = (path.back() - position).norm();
  if (step.left_m <= limits.lookahead_m && to_end_m <= limits.arrive_m) return step;

  step.arrived = false;
  const Point aim = motion::point_along(path, step.state.along_m + limits.lookahead_m);
  const double error_rad = motion::heading_error(T_map_robot, aim);
  const bool can_turn = limits.min_turning_radius_m <= 0.0;
  step.state.turning =
      can_turn && std::abs(error_rad) > (state.turning ? limits.how.aligned_rad : limits.how.turn_in_place_rad);
  if (step.state.turning) {
    step.wanted = motion::turn_by(error_rad, limits.max_w_radps, limits.how.turn);
  } else {
    const double v_mps = speed_towards_end(std::max(step.left_m, to_end_m), limits);
    step.wanted = pursuit(error_rad, (aim - position).norm(), v_mps, limits);
  }
  return step;
}

}  // namespace cairn::pursuit_dwa
