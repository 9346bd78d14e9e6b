// Information of planar poses (an inverse covariance of x_m, y_m, theta_rad) as edges of pose graphs have it.
#pragma once

#include <Eigen/Core>

namespace cairn {

// Covariance with a floor: what is measured is never better than that.
[[nodiscard]] Eigen::Matrix3d with_floor(const Eigen::Matrix3d& information, double floor_m, double floor_rad);
// As it is in a frame turned by -angle; a covariance is turned alike.
[[nodiscard]] Eigen::Matrix3d information_in_turned(const Eigen::Matrix3d& information, double angle_rad);

}  // namespace cairn
