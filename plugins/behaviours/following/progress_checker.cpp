#include "plugins/behaviours/following/progress_checker.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::behaviours {

void ProgressSettings::describe(Fields<ProgressSettings>& fields) {
  using C = ProgressSettings;
  fields.number("speed_reduction_ratio", &C::speed_reduction_ratio, {0.0, 1.0}, "",
                "the robot is blocked while the collision monitor cuts more than this share of its speed");
  fields.number("standing_ratio", &C::standing_ratio, {0.0, 1.0}, "",
                "or while it moves at less than this share of the speed it wants");
  fields.number("bump_s", &C::bump_s, {0.0, 60.0}, "s", "after a bump it waits for so long only");
  fields.number("recovery_ratio", &C::recovery_ratio, {0.0, 100.0}, "",
                "each second of progress makes up for so many seconds without");
}

bool ProgressChecker::is_stuck(const WorldView& world, const Twist& wanted) {
  const Pose2& pose = world.pose.T_map_robot;
  const double passed_s = last_s_ < 0.0 ? 0.0 : world.time_s - last_s_;
  const double moved_m = (pose.position() - T_map_last_.position()).norm();
  const double turned_rad = std::abs(wrap_angle(pose.theta_rad - T_map_last_.theta_rad));
  last_s_ = world.time_s;
  T_map_last_ = pose;
  const bool goes_ahead = wanted.v_mps > 0.0;
  if (!goes_ahead && (wanted.v_mps < 0.0 || wanted.w_radps == 0.0)) return false;

  const bool stands = goes_ahead ? moved_m < settings_.standing_ratio * wanted.v_mps * passed_s
                                 : turned_rad < settings_.standing_ratio * std::abs(wanted.w_radps) * passed_s;
  if (world.speed_reduction_ratio > settings_.speed_reduction_ratio || stands) {
    stuck_s_ += passed_s;
  } else {
    stuck_s_ = std::max(0.0, stuck_s_ - settings_.recovery_ratio * passed_s);
  }
  const bool bumped = goes_ahead && world.observation != nullptr && world.observation->bumped;
  return stuck_s_ > patience_s_ || (bumped && stuck_s_ > settings_.bump_s);
}

}  // namespace cairn::behaviours
