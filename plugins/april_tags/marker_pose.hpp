// Where an upright square stands whose corners a camera sees: its place on the floor plan, its direction and its
// height are fitted to the corners, with the lens and its mounting as the robot file has them.
#pragma once

#include <array>
#include <optional>

#include "framework/contracts/marker.hpp"
#include "plugins/common/camera/lens.hpp"

namespace cairn::april_tags {

struct PoseErrors {
  double corner_px = 0.15;       // standard deviation of a corner
  double min_position_m = 0.01;  // of the pose, at least
  double min_angle_rad = 0.0087;
};

struct MarkerPoses {
  MarkerPose best;
  std::optional<MarkerPose> mirrored;  // when it explains the corners about as well
};

// corners: lower left, lower right, upper right, upper left. Nothing: these are no corners of an upright square.
[[nodiscard]] std::optional<MarkerPoses> pose_of_square(const CameraModel& camera, double size_m,
                                                        const std::array<Pixel, 4>& corners, const PoseErrors& errors);

}  // namespace cairn::april_tags
