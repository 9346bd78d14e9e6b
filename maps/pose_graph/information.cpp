#include "maps/pose_graph/information.hpp"

#include <Eigen/LU>
#include <cmath>

namespace cairn {

Eigen::Matrix3d with_floor(const Eigen::Matrix3d& information, double floor_m, double floor_rad) {
  const Eigen::Matrix3d covariance = (information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  const Eigen::Vector3d floor(floor_m * floor_m, floor_m * floor_m, floor_rad * floor_rad);
  const Eigen::Matrix3d floored = covariance + Eigen::Matrix3d(floor.asDiagonal());
  const Eigen::Matrix3d result = floored.inverse();
  return 0.5 * (result + result.transpose());
}

Eigen::Matrix3d information_in_turned(const Eigen::Matrix3d& information, double angle_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return turn.transpose() * information * turn;
}

}  // namespace cairn
