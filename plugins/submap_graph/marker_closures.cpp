#include "plugins/submap_graph/marker_closures.hpp"

#include <Eigen/LU>

#include "maps/pose_graph/information.hpp"

namespace cairn::submap_graph {
namespace {

constexpr std::size_t kMinNodes = 12;      // between two places that a marker ties
constexpr double kSightingFloor_m = 0.03;  // of the way between node and sighting
constexpr double kSightingFloor_rad = radians(0.5);

// Errors of a pose that stands at the end of T, as errors of where T begins from there.
Eigen::Matrix3d seen_from_start(const Eigen::Matrix3d& at_end, const Pose2& T) {
  Eigen::Matrix3d arm = Eigen::Matrix3d::Identity();
  arm(0, 2) = T.y_m;
  arm(1, 2) = -T.x_m;
  return arm * information_in_turned(at_end, -T.theta_rad) * arm.transpose();
}

}  // namespace

std::optional<Closure> MarkerClosures::see(const MarkerSighting& sighting, std::size_t node,
                                           const Pose2& T_node_robot) {
  if (sighting.mirrored) return std::nullopt;
  Seen seen{node, T_node_robot * sighting.pose.T_robot_marker,
            information_in_turned(sighting.pose.covariance, -T_node_robot.theta_rad)};
  seen.covariance.diagonal() +=
      Eigen::Vector3d(kSightingFloor_m * kSightingFloor_m, kSightingFloor_m * kSightingFloor_m,
                      kSightingFloor_rad * kSightingFloor_rad);
  const auto [found, is_new] = tracks_.try_emplace(sighting.marker, Track{seen, node});
  Track& track = found->second;
  if (is_new || node == track.last_node || node < track.first.node + kMinNodes) return std::nullopt;
  track.last_node = node;
  const Seen& first = track.first;
  const Eigen::Matrix3d at_marker = information_in_turned(first.covariance, first.T_node_marker.theta_rad) +
                                    information_in_turned(seen.covariance, seen.T_node_marker.theta_rad);
  const Eigen::Matrix3d information = seen_from_start(at_marker, seen.T_node_marker).inverse();
  return Closure{first.node, node, first.T_node_marker * inverse(seen.T_node_marker),
                 0.5 * (information + information.transpose()), 1.0};
}

}  // namespace cairn::submap_graph
