#include "maps/pose_graph/relation_errors.hpp"

#include <algorithm>

namespace cairn {
namespace {

// Of poses in the order of their stamps; null when none is near enough.
const StampedPose* pose_at(const std::vector<StampedPose>& poses, double stamp_s, double tolerance_s) {
  const auto after = std::ranges::lower_bound(poses, stamp_s, {}, &StampedPose::stamp_s);
  const StampedPose* best = nullptr;
  const auto consider = [&](const StampedPose& pose) {
    const double apart_s = std::abs(pose.stamp_s - stamp_s);
    if (apart_s <= tolerance_s && (best == nullptr || apart_s < std::abs(best->stamp_s - stamp_s))) best = &pose;
  };
  if (after != poses.begin()) consider(*std::prev(after));
  if (after != poses.end()) consider(*after);
  return best;
}

MeanError mean_error(const std::vector<double>& errors) {
  MeanError result;
  if (errors.empty()) return result;
  const auto count = static_cast<double>(errors.size());
  for (const double error : errors) {
    result.mean += error / count;
    result.greatest = std::max(result.greatest, error);
  }
  double variance = 0.0;
  for (const double error : errors) variance += (error - result.mean) * (error - result.mean) / count;
  result.deviation = std::sqrt(variance);
  return result;
}

}  // namespace

RelationErrors relation_errors(std::span<const StatedRelation> relations, std::vector<StampedPose> poses,
                               double tolerance_s) {
  std::ranges::stable_sort(poses, {}, &StampedPose::stamp_s);
  RelationErrors errors;
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
  for (const StatedRelation& relation : relations) {
    const StampedPose* const from = pose_at(poses, relation.from_s, tolerance_s);
    const StampedPose* const to = pose_at(poses, relation.to_s, tolerance_s);
    if (from == nullptr || to == nullptr) {
      ++errors.without_pose;
      continue;
    }
    const Pose2 difference = inverse(inverse(from->T_map_robot) * to->T_map_robot) * relation.T_from_to;
    translation_m.push_back(difference.position().norm());
    rotation_deg.push_back(degrees(std::abs(difference.theta_rad)));
  }
  errors.used = translation_m.size();
  errors.translation_m = mean_error(translation_m);
  errors.rotation_deg = mean_error(rotation_deg);
  return errors;
}

}  // namespace cairn
