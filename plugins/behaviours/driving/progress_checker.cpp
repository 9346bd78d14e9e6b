#include "plugins/behaviours/driving/progress_checker.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::behaviours {
namespace {
constexpr double kSpeedReductionRatio = 0.7;
constexpr double kStandingRatio = 0.1;  // of the wanted speed
}  // namespace

bool ProgressChecker::is_stuck(const WorldView& world, const Twist& wanted) {
  const Pose2& pose = world.pose.T_map_robot;
  const double passed_s = last_s_ < 0.0 ? 0.0 : world.time_s - last_s_;
  const double moved_m = (pose.position() - T_map_last_.position()).norm();
  const double turned_rad = std::abs(wrap_angle(pose.theta_rad - T_map_last_.theta_rad));
  last_s_ = world.time_s;
  T_map_last_ = pose;
  const bool goes_ahead = wanted.v_mps > 0.0;
  if (!goes_ahead && (wanted.v_mps < 0.0 || wanted.w_radps == 0.0)) return false;

  const bool stands = goes_ahead ? moved_m < kStandingRatio * wanted.v_mps * passed_s
                                 : turned_rad < kStandingRatio * std::abs(wanted.w_radps) * passed_s;
  if (world.speed_reduction_ratio > kSpeedReductionRatio || stands) {
    stuck_s_ += passed_s;
  } else {
    stuck_s_ = std::max(0.0, stuck_s_ - 2.0 * passed_s);
  }
  const bool bumped = goes_ahead && world.observation != nullptr && world.observation->bumped;
  return stuck_s_ > patience_s_ || (bumped && stuck_s_ > 0.2);
}

}  // namespace cairn::behaviours
