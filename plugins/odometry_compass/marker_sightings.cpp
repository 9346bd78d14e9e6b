#include "plugins/odometry_compass/marker_sightings.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::odometry_compass {
namespace {

constexpr double kSaved_m = 0.03;  // standard deviations of a marker in a saved map
constexpr double kSaved_rad = radians(1.5);

double position_variance(const Eigen::Matrix3d& covariance) {
  return 0.5 * (covariance(0, 0) + covariance(1, 1));
}

bool knows_less(const Eigen::Matrix3d& now, const Eigen::Matrix3d& then) {
  return position_variance(now) > position_variance(then) || now(2, 2) > then(2, 2);
}

// From the map's axes to those of the robot.
Eigen::Matrix3d as_seen_from(const Eigen::Matrix3d& covariance, double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, s, -s, c;
  return turn * covariance * turn.transpose();
}

}  // namespace

std::span<const LandmarkSighting> MarkerSightings::look(const Observation& observation, const PoseEstimate& pose,
                                                        const KnownMap& known) {
  reported_.clear();
  anchor_markers(known.landmarks, pose.covariance);
  for (const MarkerSighting& sighting : observation.markers) {
    const Landmark* const landmark = known.landmarks.find_marker(sighting.marker);
    if (landmark == nullptr) continue;
    const Anchor& anchor = anchors_.at(landmark->id);
    if (!knows_less(pose.covariance, anchor.covariance)) continue;
    const double expected_rad = anchor.T_map_marker.theta_rad - pose.T_map_robot.theta_rad;
    const auto off_rad = [&](const MarkerPose& seen) {
      return std::abs(wrap_angle(seen.T_robot_marker.theta_rad - expected_rad));
    };
    const bool is_mirrored = sighting.mirrored && off_rad(*sighting.mirrored) < off_rad(sighting.pose);
    const MarkerPose& seen = is_mirrored ? *sighting.mirrored : sighting.pose;
    reported_.push_back({landmark->id, anchor.T_map_marker, seen.T_robot_marker,
                         seen.covariance + as_seen_from(anchor.covariance, pose.T_map_robot.theta_rad)});
  }
  return reported_;
}

// As LandmarkSightings does: a marker that has moved in the map is followed while the robot knows better where it is.
void MarkerSightings::anchor_markers(const LandmarkGraph& graph, const Eigen::Matrix3d& pose_covariance) {
  std::erase_if(anchors_, [&](const auto& entry) { return graph.find(entry.first) == nullptr; });
  const Eigen::Matrix3d saved =
      Eigen::Vector3d(kSaved_m * kSaved_m, kSaved_m * kSaved_m, kSaved_rad * kSaved_rad).asDiagonal();
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (!landmark.marker) continue;
    const auto [found, is_new] = anchors_.try_emplace(id);
    Anchor& anchor = found->second;
    if (!is_new && anchor.T_map_marker == landmark.T_map_landmark) continue;
    if (!is_new && knows_less(pose_covariance, anchor.covariance)) continue;
    anchor = {landmark.T_map_landmark, has_begun_ ? pose_covariance : saved};
  }
  has_begun_ = true;
}

}  // namespace cairn::odometry_compass
