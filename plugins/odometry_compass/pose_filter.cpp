#include "plugins/odometry_compass/pose_filter.hpp"

#include <Eigen/LU>
#include <cmath>

namespace cairn::odometry_compass {
namespace {

constexpr double squared(double x) {
  return x * x;
}

Eigen::Matrix2d rotation(double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

}  // namespace

PoseFilter::PoseFilter(const Pose2& T_map_robot, const Start& deviations)
    : state_(T_map_robot.x_m, T_map_robot.y_m, wrap_angle(T_map_robot.theta_rad), 0.0, 0.0),
      covariance_(Covariance::Zero()) {
  covariance_.diagonal() << squared(deviations.position_m), squared(deviations.position_m),
      squared(deviations.heading_rad), squared(deviations.scale_ratio), squared(deviations.bias_rad);
}

void PoseFilter::predict(const Pose2& T_before_after, const MotionNoise& noise) {
  // Odometry counts (1 + scale) metres for each metre.
  const Point seen = T_before_after.position();
  const Point moved = seen / (1.0 + state_[kScale]);
  const double distance_m = moved.norm();
  const double turn_rad = std::abs(T_before_after.theta_rad);
  const double kept = std::exp(-distance_m / noise.bias_scale_m);

  const Eigen::Matrix2d to_map = rotation(state_[kTheta]);
  const Point step = to_map * moved;
  Covariance f = Covariance::Identity();
  f(0, kTheta) = -step.y();
  f(1, kTheta) = step.x();
  f.block<2, 1>(0, kScale) = -step / (1.0 + state_[kScale]);
  f(kBias, kBias) = kept;

  Covariance q = Covariance::Zero();
  const Point forward = distance_m > 0.0 ? Point(step / distance_m) : Point(0.0, 0.0);
  const Point sideways{-forward.y(), forward.x()};
  q.topLeftCorner<2, 2>() = distance_m * (squared(noise.along_ratio) * forward * forward.transpose() +
                                          squared(noise.across_ratio) * sideways * sideways.transpose());
  q(kTheta, kTheta) = squared(noise.heading_rad_per_m) * (distance_m + noise.turn_as_distance_m_per_rad * turn_rad);
  q(kBias, kBias) = squared(noise.bias_rad) * (1.0 - kept * kept);

  state_.head<2>() += step;
  state_[kTheta] = wrap_angle(state_[kTheta] + T_before_after.theta_rad);
  state_[kBias] *= kept;
  covariance_ = (f * covariance_ * f.transpose() + q).eval();
}

bool PoseFilter::correct_heading(double compass_rad, double noise_rad, double gate_sigmas) {
  Eigen::Matrix<double, 1, kStates> h = Eigen::Matrix<double, 1, kStates>::Zero();
  h[kTheta] = 1.0;
  h[kBias] = 1.0;
  const Eigen::Matrix<double, 1, 1> innovation(wrap_angle(compass_rad - state_[kTheta] - state_[kBias]));
  return correct<1>(innovation, h, Eigen::Matrix<double, 1, 1>(squared(noise_rad)), gate_sigmas);
}

void PoseFilter::doubt_heading(double compass_rad) {
  covariance_(kTheta, kTheta) += squared(wrap_angle(compass_rad - state_[kTheta] - state_[kBias]));
}

bool PoseFilter::correct_position(const Point& p_map, const Point& p_robot, const Eigen::Matrix2d& noise,
                                  double gate_sigmas) {
  const Eigen::Matrix2d to_robot = rotation(-state_[kTheta]);
  const Point expected = to_robot * (p_map - state_.head<2>());
  Eigen::Matrix<double, 2, kStates> h = Eigen::Matrix<double, 2, kStates>::Zero();
  h.leftCols<2>() = -to_robot;
  h(0, kTheta) = expected.y();
  h(1, kTheta) = -expected.x();
  return correct<2>(p_robot - expected, h, noise, gate_sigmas);
}

bool PoseFilter::correct_pose(const Pose2& T_map_landmark, const Pose2& T_robot_landmark, const Eigen::Matrix3d& noise,
                              double gate_sigmas) {
  const Eigen::Matrix2d to_robot = rotation(-state_[kTheta]);
  const Point expected = to_robot * (T_map_landmark.position() - state_.head<2>());
  Eigen::Matrix<double, 3, kStates> h = Eigen::Matrix<double, 3, kStates>::Zero();
  h.topLeftCorner<2, 2>() = -to_robot;
  h(0, kTheta) = expected.y();
  h(1, kTheta) = -expected.x();
  h(2, kTheta) = -1.0;
  Eigen::Vector3d innovation;
  innovation.head<2>() = T_robot_landmark.position() - expected;
  innovation[2] = wrap_angle(T_robot_landmark.theta_rad - T_map_landmark.theta_rad + state_[kTheta]);
  return correct<3>(innovation, h, noise, gate_sigmas);
}

void PoseFilter::doubt_position(const Point& p_map, const Point& p_robot) {
  const Point off = p_map - rotation(state_[kTheta]) * p_robot - state_.head<2>();
  covariance_.topLeftCorner<2, 2>() += off * off.transpose();
}

template <int kRows>
bool PoseFilter::correct(const Eigen::Matrix<double, kRows, 1>& innovation,
                         const Eigen::Matrix<double, kRows, kStates>& h,
                         const Eigen::Matrix<double, kRows, kRows>& noise, double gate_sigmas) {
  const Eigen::Matrix<double, kRows, kRows> s = h * covariance_ * h.transpose() + noise;
  const Eigen::Matrix<double, kRows, kRows> s_inverse = s.inverse();
  const double off = innovation.dot(s_inverse * innovation);
  if (!(off <= squared(gate_sigmas))) return false;
  const Eigen::Matrix<double, kStates, kRows> gain = covariance_ * h.transpose() * s_inverse;
  state_ += gain * innovation;
  state_[kTheta] = wrap_angle(state_[kTheta]);
  // Joseph's form: stays symmetric and positive whatever the rounding.
  const Covariance rest = Covariance::Identity() - gain * h;
  covariance_ = (rest * covariance_ * rest.transpose() + gain * noise * gain.transpose()).eval();
  return true;
}

PoseEstimate PoseFilter::estimate() const {
  PoseEstimate estimate;
  estimate.T_map_robot = {state_[0], state_[1], state_[kTheta]};
  estimate.covariance = covariance_.topLeftCorner<3, 3>();
  return estimate;
}

}  // namespace cairn::odometry_compass
