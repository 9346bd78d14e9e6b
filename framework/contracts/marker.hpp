// Marker: a printed tag (AprilTag) that a camera recognises by its number.
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>

#include "maps/geometry/pose.hpp"

namespace cairn {

enum class MarkerFamily : std::uint8_t { tag36h11, tag25h9, tagStandard41h12 };
// As robot files, worlds and missions write it.
[[nodiscard]] constexpr std::string_view name_of(MarkerFamily family) {
  switch (family) {
    case MarkerFamily::tag36h11:
      return "36h11";
    case MarkerFamily::tag25h9:
      return "25h9";
    case MarkerFamily::tagStandard41h12:
      return "standard41h12";
  }
  return "?";
}

// Numbers are unique within a family only.
struct MarkerId {
  MarkerFamily family = MarkerFamily::tag36h11;
  int number = 0;
  auto operator<=>(const MarkerId&) const = default;
};

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
