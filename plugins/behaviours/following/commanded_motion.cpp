#include "plugins/behaviours/following/commanded_motion.hpp"

#include <algorithm>

#include "plugins/common/motion/velocity.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kLongestTick_s = 0.5;  // after a longer gap the robot accelerates as after this

}  // namespace

void CommandedMotion::tick(double time_s) {
  period_s_ = std::clamp(time_s - last_s_, 0.0, kLongestTick_s);
  last_s_ = time_s;
}

Twist CommandedMotion::velocity(const WorldView& world) const {
  const double share = 1.0 - std::clamp(world.speed_reduction_ratio, 0.0, 1.0);
  return {share * commanded_.v_mps, commanded_.w_radps};
}

void CommandedMotion::drive_towards(const Twist& target, const WorldView& world, MotionRequests& context) {
  drive(motion::approached(velocity(world), target, period_s_, motion::accelerations_of(world.robot)), context);
}

void CommandedMotion::drive(const Twist& twist, MotionRequests& context) {
  commanded_ = twist;
  context.drive(twist);
}

}  // namespace cairn::behaviours
