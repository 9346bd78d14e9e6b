// Where a robot is, from ranges and what they should have been: robust Gauss-Newton over a few dozen readings.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "maps/geometry/pose.hpp"

namespace cairn::odometry_compass {

// One reading compared with what it should have been.
struct RangeResidual {
  double off_m = 0.0;                                   // measured less expected
  Eigen::Vector3d per_shift = Eigen::Vector3d::Zero();  // d expected / d shift
  double deviation_m = 1.0;                             // standard deviation of off_m at the right place
};

struct Alignment {
  Pose2 T_from_to;                                       // from the pose it began at to the one that fits
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of T_from_to, in the frame of the pose found
  double rms_sigmas = 0.0;                               // of what the readings still are off, outliers left out
  int readings = 0;                                      // that fit
  int outliers = 0;
};

struct AlignmentLimits {
  int iterations = 8;
  int min_readings = 5;
  double min_inlier_ratio = 0.6;
  double max_rms_sigmas = 1.5;
  double max_shift_m = 0.5;
  double max_turn_rad = radians(20.0);
  double strongest_deviation_m = 0.1;  // in the direction that is known best; weaker says nothing
};

// A shift is (x_m, y_m, theta_rad) in the robot's own frame: T_map_robot * shift. `compare(i, T_map_robot)` is asked
// for every reading in every iteration; none: it does not count there. Weights are those of Geman and McClure, so that
// what stands in front (people) and crosstalk do not pull. What readings do not say (along a wall) stays as it was, at
// a deviation of 1 m and 0.5 rad. None beyond the limits, or when it does not settle: the
// last step was longer than 5 mm and mrad together.
[[nodiscard]] std::optional<Alignment> align(
    const Pose2& T_map_robot, int readings,
    const std::function<std::optional<RangeResidual>(int, const Pose2&)>& compare, const AlignmentLimits& limits = {});

}  // namespace cairn::odometry_compass
