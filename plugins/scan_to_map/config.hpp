// Settings of the scan-to-map localizer. What the robot's file says of its odometry comes from there.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::scan_to_map {

struct Config {
  double cell_m = 0.05;
  double range_noise_m = 0.02;
  double range_offset_m = 0.0;
  double pair_m = 0.3;
  int iterations = 20;
  int min_pairs = 30;
  double beams_per_pair = 1.0;
  double widest_half_beam_rad = radians(1.0);
  // Odometry: least errors, whatever the robot's file says. Wide, because small robots slip: too narrow, and a
  // scan that is right is refused; too wide costs nothing where there are walls all round.
  double min_distance_ratio = 0.3;
  double min_heading_rad_per_m = radians(60.0);
  double turn_as_distance_m_per_rad = 0.1;
  // How well the start pose is known, and how the map itself drifts.
  double start_position_m = 0.01;
  double start_heading_rad = radians(0.5);
  double drift_ratio = 0.002;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::scan_to_map
