// What libapriltag says by itself about where a square stands whose corners it has found (estimate_tag_pose).
#pragma once

#include <array>

#include "plugins/common/camera/lens.hpp"

namespace cairn {

struct RawPose {
  Pose2 T_robot_marker;  // on the floor plan
  double height_m = 0.0;
};

// corners: lower left, lower right, upper right, upper left. The camera must have no distortion, which the library does
// not know; it looks level.
[[nodiscard]] RawPose raw_pose_of(const CameraModel& camera, double size_m, const std::array<Pixel, 4>& corners);

}  // namespace cairn
