#include "plugins/behaviours/following/direct_follower.hpp"

namespace cairn::behaviours {

ControlResult DirectFollower::ask(MotionRequests& context) {
  ControlRequest request = path_.request();
  request.speed_mps = speed_mps_;
  request.tolerance_m = tolerance_m_;
  request.avoids_obstacles = false;
  const ControlResult result = context.control(request);
  path_.record(result);
  return result;
}

void DirectFollower::drive(const Twist& wanted, MotionRequests& context) {
  wanted_ = wanted;
  context.drive(wanted);
}

}  // namespace cairn::behaviours
