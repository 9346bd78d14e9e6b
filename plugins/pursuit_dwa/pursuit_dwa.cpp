#include "plugins/pursuit_dwa/pursuit_dwa.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/common/motion/path.hpp"

namespace cairn::pursuit_dwa {
namespace {

// Of a pose or a path that is not a place.
ControlResult stopped(const ControlRequest& request) {
  ControlResult result;
  result.state = ControlState::blocked;
  result.progress = request.progress;
  return result;
}

}  // namespace

void PursuitDwaConfig::describe(Fields<PursuitDwaConfig>& fields) {
  fields.group("follow", &PursuitDwaConfig::follow, "how it follows the path: pure pursuit");
  fields.group("avoid", &PursuitDwaConfig::avoid, "how it avoids obstacles: the dynamic window approach");
}

ControlResult PursuitDwa::control(const ControlRequest& request, const WorldView& world) {
  FollowLimits limits = follow_limits(world.robot, request.speed_mps, config_.follow);
  limits.speed_mps = std::min(limits.speed_mps, request.speed_limit_mps);
  limits.arrive_m = request.tolerance_m;
  const FollowStep step = follow(world.pose.T_map_robot, request.path, request.progress, limits);

  ControlResult result;
  if (step.arrived) result.state = ControlState::arrived;
  result.unhindered = step.wanted;
  result.twist = step.wanted;
  result.progress = step.state;
  result.left_m = step.left_m;
  if (request.avoids_obstacles) {
    const WindowLimits window = window_limits(world.robot, limits.speed_mps, limits.max_w_radps);
    Wish wish{step.wanted, {0.0, 0.0}};
    if (!request.path.empty())
      wish.aim =
          inverse(world.pose.T_map_robot) * motion::point_along(request.path, step.state.along_m + limits.lookahead_m);
    const WindowStep best = best_in_window(request.velocity, wish, request.obstacles, window, config_.avoid);
    if (best.blocked) result.state = ControlState::blocked;
    result.twist = motion::approached(request.velocity, best.target, request.period_s, window.accelerations);
  }
  const bool is_usable = is_finite(result.twist) && is_finite(result.unhindered) && std::isfinite(step.state.along_m);
  return is_usable ? result : stopped(request);
}

}  // namespace cairn::pursuit_dwa
