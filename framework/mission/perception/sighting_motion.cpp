#include "framework/mission/perception/sighting_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace cairn {
namespace {

constexpr double kKept_s = 2.0;  // sensors leave out pictures that are more than a second old

void move(const Pose2& T_now_then, MarkerPose& pose) {
  pose.T_robot_marker = T_now_then * pose.T_robot_marker;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_now_then.theta_rad).toRotationMatrix();
  pose.covariance = turned * pose.covariance * turned.transpose();
}

}  // namespace

void SightingMotion::add(double stamp_s, const Pose2& T_odom_robot) {
  known_.push_back({stamp_s, T_odom_robot});
  const auto kept =
      std::ranges::find_if(known_, [&](const Known& known) { return known.stamp_s >= stamp_s - kKept_s; });
  known_.erase(known_.begin(), kept);
}

Pose2 SightingMotion::at(double stamp_s) const {
  const auto after = std::ranges::lower_bound(known_, stamp_s, {}, &Known::stamp_s);
  const Known& before = *std::prev(after);
  const double ratio = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  const Pose2 step = inverse(before.T_odom_robot) * after->T_odom_robot;
  return before.T_odom_robot * Pose2{ratio * step.x_m, ratio * step.y_m, ratio * step.theta_rad};
}

void SightingMotion::bring_to_now(MarkerSighting& sighting) const {
  if (known_.empty() || sighting.stamp_s >= known_.back().stamp_s || sighting.stamp_s <= known_.front().stamp_s) return;
  const Pose2 T_now_then = inverse(known_.back().T_odom_robot) * at(sighting.stamp_s);
  move(T_now_then, sighting.pose);
  if (sighting.mirrored) move(T_now_then, *sighting.mirrored);
}

}  // namespace cairn
