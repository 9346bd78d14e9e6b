#include "plugins/behaviours/exploring/task_follower.hpp"

namespace cairn::behaviours {

void TaskFollower::see(const WorldView& world, const NearEchoes& near_echoes) {
  motion_.tick(world.time_s);
  obstacles_.see(world, near_echoes);
}

void TaskFollower::restart_progress() {
  wanted_ = {};
  progress_.restart();
}

ControlResult TaskFollower::step(double speed_limit_mps, const WorldView& world, BehaviourContext& context) {
  ControlRequest request = path_.request();
  request.speed_mps = speed_mps_;
  request.speed_limit_mps = speed_limit_mps;
  request.tolerance_m = arrived_m_;
  request.obstacles = obstacles_.points();
  request.velocity = motion_.velocity(world);
  request.period_s = motion_.period_s();
  const ControlResult result = context.control(request);
  path_.record(result);
  wanted_ = result.unhindered;
  motion_.drive(result.twist, context);
  return result;
}

void TaskFollower::drive(const Twist& wanted, const WorldView& world, BehaviourContext& context) {
  wanted_ = wanted;
  motion_.drive_towards(wanted, world, context);
}

}  // namespace cairn::behaviours
