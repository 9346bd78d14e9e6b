// The robot as its file describes it (config/robots/*.yaml).
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
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

// A scanner of thin beams, spread evenly from the first angle to the last, anticlockwise when that is the larger one.
struct LaserModel {
  Pose2 T_robot_laser;
  double first_angle_rad = -0.5 * std::numbers::pi;
  double last_angle_rad = 0.5 * std::numbers::pi;
  int beams = 181;
  double min_m = 0.05;
  double max_m = 8.0;
  double rate_hz = 10.0;
  double noise_m = 0.01;  // standard deviation of a range, plus noise_ratio * range
  double noise_ratio = 0.0;
  double dropped_ratio = 0.0;  // share of echoes lost

  [[nodiscard]] double step_rad() const { return beams > 1 ? (last_angle_rad - first_angle_rad) / (beams - 1) : 0.0; }
  [[nodiscard]] Pose2 T_robot_beam(int beam) const {
    return {T_robot_laser.x_m, T_robot_laser.y_m,
            wrap_angle(T_robot_laser.theta_rad + first_angle_rad + beam * step_rad())};
  }
};

// A pinhole with lens distortion. Pixels are counted from the centre of the upper left one.
struct CameraModel {
  Pose2 T_robot_camera;   // the lens on the floor plan, and the direction that it looks in
  double height_m = 0.3;  // of the lens above the floor
  double tilt_rad = 0.0;  // upwards from level
  int width_px = 640;
  int height_px = 480;
  double focal_x_px = 525.0;
  double focal_y_px = 525.0;
  double centre_x_px = 319.5;
  double centre_y_px = 239.5;
  std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3 (Brown, Conrady), in OpenCV's order
  double rate_hz = 5.0;
  // What a simulation adds.
  double blur_px = 0.6;         // standard deviation
  double noise_ratio = 0.01;    // standard deviation of a pixel, of the full range
  double exposure_ratio = 0.8;  // grey of a white surface, of the full range; above 1 it is overexposed
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
  std::vector<LaserModel> lasers;
  std::vector<CameraModel> cameras;
  OdometryError odometry_error;
  bool has_compass = true;
  CompassError compass_error;
  RangeError range_error;
};

// Transducers are numbered through: the sonars first, then each laser's beams.
inline constexpr int kMaxTransducers = 4096;

[[nodiscard]] inline int first_beam_of(const RobotModel& robot, std::size_t laser) {
  int number = static_cast<int>(robot.sonars.size());
  for (std::size_t i = 0; i < laser; ++i) number += robot.lasers[i].beams;
  return number;
}
// How far its farthest-looking sensor sees; 0: it has none.
[[nodiscard]] inline double farthest_range_m(const RobotModel& robot) {
  double farthest_m = 0.0;
  for (const SonarModel& sonar : robot.sonars) farthest_m = std::max(farthest_m, sonar.max_m);
  for (const LaserModel& laser : robot.lasers) farthest_m = std::max(farthest_m, laser.max_m);
  return farthest_m;
}
// Time between two observations with readings; 0: the file does not say.
[[nodiscard]] inline double reading_period_s(const RobotModel& robot) {
  if (!robot.sonars.empty() || robot.lasers.empty()) return robot.firing_period_s;
  double rate_hz = 0.0;
  for (const LaserModel& laser : robot.lasers) rate_hz = std::max(rate_hz, laser.rate_hz);
  return 1.0 / rate_hz;
}

}  // namespace cairn
