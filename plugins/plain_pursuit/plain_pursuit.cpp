#include "plugins/plain_pursuit/plain_pursuit.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/common/motion/path.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::plain_pursuit {
namespace {

constexpr double kSearch_m = 0.5;  // the nearest point of the path is looked for this far around the last one
constexpr double kCrawl_mps = 0.03;
constexpr double kStep_m = 0.05;  // along the arc, from one place that is checked to the next

// Whether the robot's disc, on its arc, would come too near to something, and nearer than it is now: it may pass what
// it stands beside, and leave it.
bool is_blocked_ahead(std::span<const Point> obstacles, double radius_m, const Twist& twist, double ahead_m) {
  const double turn_rad = kStep_m * twist.w_radps / std::max(twist.v_mps, kCrawl_mps);
  const Pose2 step{kStep_m * std::cos(0.5 * turn_rad), kStep_m * std::sin(0.5 * turn_rad), turn_rad};
  Pose2 T_robot_ahead;
  for (double along_m = 0.0; along_m < ahead_m; along_m += kStep_m) {
    T_robot_ahead = T_robot_ahead * step;
    const Point centre = T_robot_ahead.position();
    const auto is_hit = [&](const Point& p) { return (p - centre).norm() < std::min(radius_m, p.norm()); };
    if (std::ranges::any_of(obstacles, is_hit)) return true;
  }
  return false;
}

// The arc from the robot to the aim, slower towards the end of the path.
Twist arc_to(const Point& aim, double left_m, double top_mps, double deceleration_mps2) {
  const double v_mps = std::min(top_mps, std::max(kCrawl_mps, std::sqrt(deceleration_mps2 * left_m)));
  return {v_mps, v_mps * 2.0 * aim.y() / std::max(aim.squaredNorm(), 0.01)};
}

// The same arc, no faster than the robot turns and no tighter than it can.
Twist within(const Twist& twist, double max_w_radps, double min_turning_radius_m) {
  Twist result = twist;
  if (std::abs(result.w_radps) > max_w_radps) {
    result.v_mps *= max_w_radps / std::abs(result.w_radps);
    result.w_radps = std::copysign(max_w_radps, result.w_radps);
  }
  if (min_turning_radius_m > 0.0) {
    const double max_radps = std::abs(result.v_mps) / min_turning_radius_m;
    result.w_radps = std::clamp(result.w_radps, -max_radps, max_radps);
  }
  return result;
}

}  // namespace

void PlainPursuitConfig::describe(Fields<PlainPursuitConfig>& fields) {
  using C = PlainPursuitConfig;
  fields.number("lookahead_m", &C::lookahead_m, {0.05, 5.0}, "m", "it aims at the point of the path this far ahead");
  fields.number("clearance_m", &C::clearance_m, {0.0, 2.0}, "m", "room that obstacles must leave beside the robot");
  fields.number("stop_ahead_m", &C::stop_ahead_m, {0.05, 5.0}, "m",
                "it stops when its arc leads too near to an obstacle within this");
  fields.angle("turn_in_place_deg", &C::turn_in_place_rad, {5.0, 180.0},
               "with a larger heading error it turns in place; a car never does");
  fields.angle("max_turn_degps", &C::max_turn_radps, {1.0, 360.0}, "fastest turn, within the robot's own limits",
               "deg/s");
}

ControlResult PlainPursuit::control(const ControlRequest& request, const WorldView& world) {
  const Pose2& T_map_robot = world.pose.T_map_robot;
  ControlResult result;
  result.state = ControlState::arrived;
  result.progress = request.progress;
  if (request.path.empty()) return result;

  const double from_m = request.progress.along_m;
  const motion::NearestOnPath nearest =
      motion::nearest_on(request.path, T_map_robot.position(), from_m - kSearch_m, from_m + kSearch_m);
  result.progress.along_m = std::max(from_m, nearest.along_m);
  result.left_m = length_of(request.path) - result.progress.along_m;
  const double to_end_m = (request.path.back() - T_map_robot.position()).norm();
  if (result.left_m <= config_.lookahead_m && to_end_m <= request.tolerance_m) return result;

  result.state = ControlState::following;
  const Point aim =
      inverse(T_map_robot) * motion::point_along(request.path, result.progress.along_m + config_.lookahead_m);
  const double error_rad = std::atan2(aim.y(), aim.x());
  const motion::Accelerations limits = motion::accelerations_of(world.robot);
  const double max_w_radps = std::min(config_.max_turn_radps, world.robot.max_w_radps);
  const double top_mps = std::min({request.speed_mps, request.speed_limit_mps, world.robot.max_v_mps});
  result.progress.turning = limits.min_turning_radius_m <= 0.0 && std::abs(error_rad) > config_.turn_in_place_rad;
  result.unhindered = result.progress.turning
                          ? motion::turn_by(error_rad, max_w_radps)
                          : within(arc_to(aim, std::max(result.left_m, to_end_m), top_mps, limits.forward_mps2),
                                   max_w_radps, limits.min_turning_radius_m);
  result.twist = result.unhindered;
  if (request.avoids_obstacles && !result.progress.turning &&
      is_blocked_ahead(request.obstacles, world.robot.radius_m + config_.clearance_m, result.twist,
                       std::min(config_.stop_ahead_m, result.left_m))) {
    result.state = ControlState::blocked;
    result.twist = {};
  }
  if (!std::isfinite(result.twist.v_mps) || !std::isfinite(result.twist.w_radps) ||
      !std::isfinite(result.progress.along_m)) {
    result = {};
    result.state = ControlState::blocked;
  }
  return result;
}

}  // namespace cairn::plain_pursuit
