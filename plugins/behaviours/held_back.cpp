#include "plugins/behaviours/held_back.hpp"

#include <algorithm>

namespace cairn::behaviours {
namespace {
constexpr double kHeldBackRatio = 0.7;
constexpr double kStandingRatio = 0.1;  // of the wanted speed
}  // namespace

bool HeldBackWatch::is_stuck(const WorldView& world, const Twist& wanted) {
  const Point position = world.pose.T_map_robot.position();
  const double passed_s = last_s_ < 0.0 ? 0.0 : world.time_s - last_s_;
  const double moved_m = (position - last_position_).norm();
  last_s_ = world.time_s;
  last_position_ = position;
  if (wanted.v_mps <= 0.0) return false;  // turning says nothing

  const bool stands = moved_m < kStandingRatio * wanted.v_mps * passed_s;
  if (world.held_back_ratio > kHeldBackRatio || stands) {
    stuck_s_ += passed_s;
  } else {
    stuck_s_ = std::max(0.0, stuck_s_ - 2.0 * passed_s);
  }
  const bool bumped = world.observation != nullptr && world.observation->bumped;
  return stuck_s_ > patience_s_ || (bumped && stuck_s_ > 0.2);
}

}  // namespace cairn::behaviours
