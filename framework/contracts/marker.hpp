// Marker: a printed tag (AprilTag) that a camera recognises by its number.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "maps/geometry/pose.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn {

// Where a marker stands by one picture. It hangs upright: theta_rad is the direction that its printed side faces.
struct MarkerPose {
  Pose2 T_robot_marker;
  double height_m = 0.0;                                 // of its centre above the floor
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x_m, y_m, theta_rad
  double reprojection_error_px = 0.0;                    // of its corners, root mean square
};

// A marker in one picture, as it reaches the localizer.
struct MarkerSighting {
  MarkerId marker;
  int camera = 0;        // index in RobotModel::cameras
  double stamp_s = 0.0;  // of the picture, by the observation's clock
  MarkerPose pose;       // the one that fits the picture better
  // A small or far square looks almost the same turned to the other side. None: the picture has decided.
  std::optional<MarkerPose> mirrored;
};

}  // namespace cairn
