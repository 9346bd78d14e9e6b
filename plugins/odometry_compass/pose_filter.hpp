// Extended Kalman filter over a planar pose and the two slow errors that would make it dishonest.
//
// State: x_m, y_m, theta_rad of T_map_robot; the odometry's scale error (constant over a run); the
// compass's local bias (first-order Gauss-Markov over the distance driven). With both deviations 0 it
// is the plain three-state filter. Angles are kept in (-pi, pi], innovations are wrapped.
#pragma once

#include <Eigen/Core>

#include "framework/contracts/localizer.hpp"

namespace cairn::odometry_compass {

// Standard deviations; _per_m ones grow with the root of the distance.
struct MotionNoise {
  double along_ratio = 0.0;  // of the distance, independent from metre to metre
  double across_ratio = 0.0;
  double heading_rad_per_m = 0.0;
  double turn_as_distance_m_per_rad = 0.0;
  double bias_rad = 0.0;      // stationary deviation of the compass bias
  double bias_scale_m = 1.0;  // distance over which it forgets itself
};

class PoseFilter {
 public:
  struct Start {
    double position_m = 0.0;
    double heading_rad = 0.0;
    double scale_ratio = 0.0;
    double bias_rad = 0.0;
  };
  PoseFilter(const Pose2& T_map_robot, const Start& deviations);

  // T_before_after: the motion as odometry saw it. No motion adds no error.
  void predict(const Pose2& T_before_after, const MotionNoise& noise);
  // Compass. Returns false, and does nothing, when the reading is more than gate deviations off.
  bool correct_heading(double compass_rad, double noise_rad, double gate_sigmas);
  // Widens the heading so that this reading passes any gate.
  void doubt_heading(double compass_rad);
  // Landmark position in robot coordinates; the same gate rule on the Mahalanobis distance.
  bool correct_position(const Point& p_map, const Point& p_robot, const Eigen::Matrix2d& noise, double gate_sigmas);
  // Landmark position and orientation in robot coordinates, whose errors may go together.
  bool correct_pose(const Pose2& T_map_landmark, const Pose2& T_robot_landmark, const Eigen::Matrix3d& noise,
                    double gate_sigmas);
  // Widens the position so that this landmark position in robot coordinates passes any gate.
  void doubt_position(const Point& p_map, const Point& p_robot);

  [[nodiscard]] PoseEstimate estimate() const;

 private:
  static constexpr int kStates = 5;
  static constexpr int kTheta = 2;
  static constexpr int kScale = 3;
  static constexpr int kBias = 4;
  using State = Eigen::Matrix<double, kStates, 1>;
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  template <int kRows>
  bool correct(const Eigen::Matrix<double, kRows, 1>& innovation, const Eigen::Matrix<double, kRows, kStates>& h,
               const Eigen::Matrix<double, kRows, kRows>& noise, double gate_sigmas);

  State state_;
  Covariance covariance_;
};

}  // namespace cairn::odometry_compass
