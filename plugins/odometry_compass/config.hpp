// Settings of the localizer. What the robot's file says of its errors comes from there.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::odometry_compass {

struct Config {
  // How well the start pose is known.
  double start_position_m = 0.01;
  double start_heading_rad = radians(0.5);
  // Odometry: least errors, whatever the robot's file says, and what its file does not say.
  double min_distance_ratio = 0.002;
  double min_heading_rad_per_m = radians(0.1);
  double turn_as_distance_m_per_rad = 0.1;
  // Compass.
  bool use_compass = true;
  double min_compass_noise_rad = radians(0.5);
  double local_bias_ratio = 0.63;
  double unstated_bias_rad = radians(5.0);
  double compass_gate_sigmas = 4.0;
  double compass_drift_sigmas = 4.5;
  double compass_jump_sigmas = 4.0;
  double compass_refused_at_most_s = 15.0;
  bool bound_bias = true;
  // Walls.
  bool use_walls = true;
  double wall_gate_sigmas = 3.5;
  // Landmarks.
  bool use_landmarks = true;
  double landmark_noise_m = 0.02;
  double landmark_gate_sigmas = 3.5;
  bool use_landmark_heading = true;
  int landmark_refusals = 8;
  double refusals_agree_m = 0.15;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::odometry_compass
