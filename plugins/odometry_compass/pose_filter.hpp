// Extended Kalman filter over a planar pose, the two slow errors that would make it dishonest, and the walls that the
// robot has met (EKF-SLAM: Smith, Self and Cheeseman 1990; with walls from sonar: Tardos et al. 2002).
//
// State: x_m, y_m, theta_rad of T_map_robot; the odometry's scale error (constant over a run); the compass's local
// bias (first-order Gauss-Markov over the distance driven); then, for each wall, the direction of its normal and its
// distance along it from a fixed place. With both deviations 0 and no walls it is the plain three-state filter. Angles
// are kept in (-pi, pi], innovations are wrapped. Never allocates.
#pragma once

#include <Eigen/Core>
#include <array>

#include "framework/contracts/localizer.hpp"
#include "plugins/odometry_compass/wall.hpp"

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
  static constexpr int kMaxWalls = 48;

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
  struct HeadingOff {
    double off_rad = 0.0;  // of the reading from what is expected
    double sigma_rad = 0.0;
  };
  [[nodiscard]] HeadingOff compare_heading(double compass_rad, double noise_rad) const;
  // Widens the heading by that.
  void doubt_heading(double off_rad);
  // Widens the compass's bias by that.
  void doubt_bias(double off_rad);
  // Nothing is known of the bias but its deviation.
  void restart_bias(double deviation_rad);
  [[nodiscard]] double bias_rad() const { return state_[kBias]; }
  // The robot has gone so much farther along its heading than it was believed, give or take the deviation.
  void slide(double along_m, double deviation_m);
  // Brings a compass bias that is beyond that bound back within it, and all that goes together with it: the moments of
  // the distribution cut off there (Simon 2010, section 2.4). Nothing is done within the bounds.
  void bound_bias(double max_rad);
  // Landmark position in robot coordinates; the same gate rule on the Mahalanobis distance.
  bool correct_position(const Point& p_map, const Point& p_robot, const Eigen::Matrix2d& noise, double gate_sigmas);
  // Landmark position and orientation in robot coordinates, whose errors may go together.
  bool correct_pose(const Pose2& T_map_landmark, const Pose2& T_robot_landmark, const Eigen::Matrix3d& noise,
                    double gate_sigmas);
  // Widens the position so that this landmark position in robot coordinates passes any gate.
  void doubt_position(const Point& p_map, const Point& p_robot);

  enum class WallUse { known, added, refused };
  // A wall: corrects by the known one that it is, or joins as a new one when it is like none. Between two that it may
  // be, or like one but beyond the gate, it is refused; so is a new one when there is no more room.
  WallUse meet(const SeenWall& seen, double gate_sigmas);
  [[nodiscard]] int walls() const { return walls_; }
  [[nodiscard]] ExpectedWall expected(int wall) const;
  // Corrects by a wall that is known to be this one. Returns false, and does nothing, beyond the gate.
  bool meet_again(int wall, const SeenWall& seen, double gate_sigmas);

  // Of meet(): the wall that it was.
  [[nodiscard]] int last_met() const { return last_met_; }
  // Squared Mahalanobis distance of what was measured last, refused or not.
  [[nodiscard]] double last_off_squared_sigmas() const { return last_off_; }

  [[nodiscard]] PoseEstimate estimate() const;

 private:
  static constexpr int kPoseStates = 5;
  static constexpr int kTheta = 2;
  static constexpr int kScale = 3;
  static constexpr int kBias = 4;
  static constexpr int kMaxStates = kPoseStates + 2 * kMaxWalls;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxStates, 1>;
  using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;
  // What a measurement of kRows numbers depends on: the pose states and, where there is one, a wall.
  template <int kRows>
  struct Slope {
    Eigen::Matrix<double, kRows, kPoseStates> pose = Eigen::Matrix<double, kRows, kPoseStates>::Zero();
    Eigen::Matrix<double, kRows, 2> wall = Eigen::Matrix<double, kRows, 2>::Zero();
    int wall_state = -1;  // its first
  };
  struct Wall {
    Point from_m{0.0, 0.0};  // what its distance counts from
    double begin_m = 0.0;    // what of it has been met, along it
    double end_m = 0.0;
    int meetings = 0;
  };
  struct Match;

  template <int kRows>
  [[nodiscard]] Eigen::Matrix<double, kRows, kRows> spread(const Slope<kRows>& h,
                                                           const Eigen::Matrix<double, kRows, kRows>& noise) const;
  template <int kRows>
  bool correct(const Eigen::Matrix<double, kRows, 1>& innovation, const Slope<kRows>& h,
               const Eigen::Matrix<double, kRows, kRows>& noise, double gate_sigmas);
  [[nodiscard]] Match compare(int wall, const SeenWall& seen) const;
  void add(const SeenWall& seen);
  void stretch(int wall, const SeenWall& seen);
  [[nodiscard]] bool forget_one();

  State state_;
  Covariance covariance_;
  std::array<Wall, kMaxWalls> wall_;
  int walls_ = 0;
  int last_met_ = -1;
  double last_off_ = 0.0;
};

}  // namespace cairn::odometry_compass
