// Settings of the submap graph.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::submap_graph {

// Of the fields that scans are searched in.
inline constexpr double kFieldCell_m = 0.1;

struct Config {
  // Scans.
  double longest_m = 30.0;
  double point_spacing_m = 0.04;
  double widest_half_beam_rad = radians(1.0);
  double sweep_s = 0.0;
  // Matching with the submap under way.
  double surface_cell_m = 0.1;
  double echo_sigma_m = 0.03;
  double search_m = 0.3;
  double search_rad = radians(12.0);
  double search_sigma_m = 0.12;
  double odometry_ratio = 0.2;
  double odometry_rad_per_m = radians(10.0);
  double odometry_rad_per_rad = 0.1;
  double odometry_turn_bias_ratio = 0.02;
  double odometry_length_bias_ratio = 0.0;
  // The compass.
  bool use_compass = true;
  double min_compass_noise_rad = radians(2.0);
  double compass_bias_rad = radians(30.0);
  double min_compass_local_bias_rad = radians(3.0);
  // Nodes and submaps.
  double node_m = 0.5;
  double node_rad = radians(15.0);
  double submap_m = 5.0;
  double gather_m = 0.0;
  // Closures.
  double drift_ratio = 0.03;
  double witness_m = 15.0;
  int solve_every_nodes = 10;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::submap_graph
