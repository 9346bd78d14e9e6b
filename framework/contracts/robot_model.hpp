// The robot as its file describes it (config/robots/*.yaml).
#pragma once

#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct SonarModel {
  Pose2 T_robot_sonar;
  double half_beam_rad = radians(15.0);
  double min_m = 0.1;
  double max_m = 5.0;
};

// Standard deviations unless the name says otherwise.
struct OdometryError {
  double distance_ratio = 0.0;       // of the distance driven, independent from metre to metre
  double distance_bias_ratio = 0.0;  // constant over a run, drawn once
  double heading_rad_per_m = 0.0;    // independent from metre to metre
};

struct CompassError {
  double noise_rad = 0.0;           // white, each reading
  double local_bias_rad = 0.0;      // bound of a bias that wanders from place to place
  double local_bias_scale_m = 2.0;  // distance over which that bias changes
};

struct RangeError {
  double noise_m = 0.005;  // plus noise_ratio * range
  double noise_ratio = 0.005;
  double dropped_ratio = 0.01;     // share of echoes lost
  double crosstalk_ratio = 0.005;  // share of readings replaced by a random range, as another transducer's echo would
};

enum class Kinematics { differential, car };

struct RobotModel {
  std::string name;
  double radius_m = 0.22;
  std::vector<Point> polygon_m;  // footprint when not round; radius_m then encloses it
  double max_v_mps = 0.4;
  double max_w_radps = radians(100.0);
  double max_acceleration_mps2 = 0.5;
  double max_turn_acceleration_radps2 = radians(200.0);
  double min_turning_radius_m = 0.0;  // car
  Kinematics kinematics = Kinematics::differential;
  std::vector<SonarModel> sonars;
  std::vector<int> firing_order;  // indices into sonars; empty: as listed
  double firing_period_s = 0.04;  // one transducer each period
  OdometryError odometry_error;
  bool has_compass = true;
  CompassError compass_error;
  RangeError range_error;
};

}  // namespace cairn
