// Where a camera's pixels look, and where a place appears in its picture. The robot's frame: x ahead, y left, z up from
// the floor.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

using Pixel = Eigen::Vector2d;  // x, y from the centre of the upper left one

// On the plane one ahead of the lens: x to the right, y down. Distortion that cannot be undone gives the nearest that
// was found.
[[nodiscard]] Eigen::Vector2d undistorted(const CameraModel& camera, const Pixel& pixel);

// From the lens through such a point, its part along the axis 1. Frame: that of the robot, turned to where the camera
// looks.
[[nodiscard]] Eigen::Vector3d direction_of(const CameraModel& camera, const Eigen::Vector2d& on_plane);

// Nothing: it lies behind the lens. The pixel may lie outside the picture.
[[nodiscard]] std::optional<Pixel> pixel_of(const CameraModel& camera, const Eigen::Vector3d& p_robot_m);

}  // namespace cairn
