// The robot's own senses of motion, with the errors that its file gives them.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "plugins/simulated_robot/noise_stream.hpp"
#include "plugins/simulated_robot/surroundings/body.hpp"

namespace cairn {

// Dead reckoning. The variance of both errors grows in proportion to the distance, so that after d
// metres the deviations are ratio * sqrt(d * 1 m) and heading_rad_per_m * sqrt(d * 1 m); the share of
// distance_bias_ratio is drawn once. A turn counts as some distance for the heading.
class Odometer {
 public:
  Odometer(const OdometryError& error, double turn_as_distance_m_per_rad, std::uint64_t seed);

  void add(const Move& move);
  [[nodiscard]] const Pose2& T_odom_robot() const { return T_odom_robot_; }

 private:
  OdometryError error_;
  double turn_as_distance_m_per_rad_;
  NoiseStream noise_;
  double scale_;
  Pose2 T_odom_robot_;
};

// Heading in the map frame, with white noise and a bias that depends on the place only: a smooth random
// field of the run, never above its bound.
class Compass {
 public:
  Compass(const CompassError& error, std::uint64_t seed);

  [[nodiscard]] double bias_rad(const Point& p_m) const;
  [[nodiscard]] double read(const Pose2& T_map_robot);

 private:
  struct Wave {
    Point wave_number_radpm;
    double phase_rad;
  };

  CompassError error_;
  std::vector<Wave> waves_;
  NoiseStream noise_;
};

}  // namespace cairn
