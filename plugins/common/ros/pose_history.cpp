#include "plugins/common/ros/pose_history.hpp"

#include <algorithm>

namespace cairn::ros {
namespace {

constexpr double kKept_s = 2.0;

}  // namespace

void PoseHistory::add(double stamp_s, const Pose2& T_odom_robot) {
  if (!known_.empty() && stamp_s < known_.back().stamp_s) known_.clear();
  known_.push_back({stamp_s, T_odom_robot});
  while (known_.front().stamp_s < stamp_s - kKept_s) known_.pop_front();
}

std::optional<Pose2> PoseHistory::at(double stamp_s) const {
  if (known_.empty()) return std::nullopt;
  const auto after = std::ranges::lower_bound(known_, stamp_s, {}, &Known::stamp_s);
  if (after == known_.end()) return known_.back().T_odom_robot;
  if (after == known_.begin()) return after->T_odom_robot;
  const Known& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  const Pose2 step = inverse(before.T_odom_robot) * after->T_odom_robot;
  return before.T_odom_robot * Pose2{share * step.x_m, share * step.y_m, share * step.theta_rad};
}

}  // namespace cairn::ros
