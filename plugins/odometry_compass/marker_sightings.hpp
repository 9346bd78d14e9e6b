// Printed markers that the map holds, seen again.
//
// A marker counts from where it was when it became known, with what the robot did not know of its own place then: it
// corrects the pose only while the robot knows less. Those of a map that was there before the first observation are
// taken as well known.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "plugins/odometry_compass/landmark_sightings.hpp"

namespace cairn::odometry_compass {

class MarkerSightings {
 public:
  // pose: the robot's at this observation. At each observation, in their order. Valid until the next call.
  [[nodiscard]] std::span<const LandmarkSighting> look(const Observation& observation, const PoseEstimate& pose,
                                                       const KnownMap& known);

 private:
  struct Anchor {
    Pose2 T_map_marker;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the robot's pose then
  };

  void anchor_markers(const LandmarkGraph& graph, const Eigen::Matrix3d& pose_covariance);

  std::map<LandmarkId, Anchor> anchors_;
  std::vector<LandmarkSighting> reported_;
  bool has_begun_ = false;
};

}  // namespace cairn::odometry_compass
