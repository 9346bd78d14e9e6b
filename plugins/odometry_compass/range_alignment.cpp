#include "plugins/odometry_compass/range_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cairn::odometry_compass {
namespace {

constexpr double kOutlier_sigmas = 3.0;
constexpr double kSettled = 1e-4;            // m, rad
constexpr double kStillMoves = 5e-3;         // after the last iteration: far below what a sighting is believed to
const Eigen::Vector3d kHold(1.0, 1.0, 4.0);  // information: 1 m, 0.5 rad

struct Sum {
  Eigen::Matrix3d information = kHold.asDiagonal();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int inliers = 0;
  int outliers = 0;
};

Pose2 shifted_by(const Eigen::Vector3d& shift) {
  return {shift.x(), shift.y(), wrap_angle(shift.z())};
}

// width: what counts as an outlier, over the deviation; wide at first, so that the right ones are found.
template <class Compare>
Sum summed(const Pose2& T_map_robot, const Eigen::Vector3d& from_begin, int readings, const Compare& compare,
           double width) {
  Sum sum;
  sum.gradient = -kHold.cwiseProduct(from_begin);
  for (int i = 0; i < readings; ++i) {
    const std::optional<RangeResidual> residual = compare(i, T_map_robot);
    if (!residual) continue;
    const double off = residual->off_m / residual->deviation_m;
    const bool fits = std::abs(off) <= kOutlier_sigmas;
    ++(fits ? sum.inliers : sum.outliers);
    if (fits) sum.squares += off * off;
    const double share = width * width / (width * width + off * off);
    const double weight = share * share / (residual->deviation_m * residual->deviation_m);
    sum.information += weight * residual->per_shift * residual->per_shift.transpose();
    sum.gradient += weight * residual->off_m * residual->per_shift;
  }
  return sum;
}

}  // namespace

std::optional<Alignment> align(const Pose2& T_map_robot, int readings,
                               const std::function<std::optional<RangeResidual>(int, const Pose2&)>& compare,
                               const AlignmentLimits& limits) {
  if (readings < limits.min_readings) return std::nullopt;
  Pose2 T_map_now = T_map_robot;
  double change = 1.0;
  for (int i = 0; i < limits.iterations && change > kSettled; ++i) {
    const Pose2 T_begin_now = inverse(T_map_robot) * T_map_now;
    const Eigen::Vector3d from_begin(T_begin_now.x_m, T_begin_now.y_m, T_begin_now.theta_rad);
    const Sum sum = summed(T_map_now, from_begin, readings, compare, i == 0 ? 6.0 : i == 1 ? 4.0 : kOutlier_sigmas);
    const Eigen::Vector3d step = sum.information.ldlt().solve(sum.gradient);
    if (!step.allFinite()) return std::nullopt;
    T_map_now = T_map_now * shifted_by(step);
    change = step.norm();
    const Pose2 moved = inverse(T_map_robot) * T_map_now;
    if (moved.position().norm() > limits.max_shift_m || std::abs(moved.theta_rad) > limits.max_turn_rad)
      return std::nullopt;
  }
  if (change > kStillMoves) return std::nullopt;
  const Sum sum = summed(T_map_now, Eigen::Vector3d::Zero(), readings, compare, kOutlier_sigmas);
  Alignment found{inverse(T_map_robot) * T_map_now, sum.information.inverse(), 0.0, sum.inliers, sum.outliers};
  if (found.readings < limits.min_readings ||
      found.readings < limits.min_inlier_ratio * (found.readings + found.outliers))
    return std::nullopt;
  found.rms_sigmas = std::sqrt(sum.squares / found.readings);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(found.covariance.topLeftCorner<2, 2>(),
                                                            Eigen::EigenvaluesOnly);
  const double strongest_m = std::sqrt(std::max(0.0, axes.eigenvalues()[0]));
  if (found.rms_sigmas > limits.max_rms_sigmas || strongest_m > limits.strongest_deviation_m) return std::nullopt;
  return found;
}

}  // namespace cairn::odometry_compass
