// Laser lines of a CARMEN log as numbers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "plugins/carmen_log/config.hpp"
#include "plugins/common/logs/log_line.hpp"

namespace cairn::carmen_log {

// The PARAM lines so far.
using Params = std::map<std::string, std::string, std::less<>>;

struct LaserLine {
  std::size_t first_range = 0;  // words
  std::size_t ranges = 0;
  Pose2 T_log_laser;
  Pose2 T_odom_robot;  // in the log's odometry
  double stamp_s = 0.0;
  double unit_m = 1.0;      // of the ranges
  bool has_both = false;    // a pose, perhaps corrected, and odometry beside it
  bool says_place = false;  // the two poses say where the laser sits
  // What only ROBOTLASER and RAWLASER say.
  bool says_fan = false;
  double first_angle_rad = 0.0;
  double step_rad = 0.0;
  double max_m = 0.0;
};

// FLASER and RLASER: n r1..rn x y theta odom_x odom_y odom_theta time [host [time]].
// Throws ConfigError when the words do not fit the count or are no numbers.
[[nodiscard]] LaserLine read_flaser(const log_common::LogLine& line);
// ROBOTLASER1 and 2, with remissions and turn axis, or without both.
[[nodiscard]] LaserLine read_robotlaser(const log_common::LogLine& line);
// LASER_READING of GMapping's logs: n r1..rn x y theta time; the pose is the odometry.
[[nodiscard]] LaserLine read_laser_reading(const log_common::LogLine& line);
// L of old logs: x y theta laser_x laser_y laser_theta r1..rn time, in cm and radians.
[[nodiscard]] LaserLine read_l_line(const log_common::LogLine& line);
[[nodiscard]] Pose2 pose_in_cm(const log_common::LogLine& line, std::size_t first_word);
// RAWLASER1 and 2, which have no poses.
[[nodiscard]] LaserLine read_rawlaser(const log_common::LogLine& line);

// Where the log says that the laser sits on the robot: the line itself (ROBOTLASER's, to 0.1 mm since
// both its poses are rounded), else PARAM.
[[nodiscard]] Pose2 said_place(const LaserLine& line, const Params& params, bool rear);

// The beams of a line and their longest range: the settings, then the line itself, then PARAM.
[[nodiscard]] log_common::Fan fan_of(const LaserLine& line, const Pose2& T_robot_laser,
                                     const log_common::LaserConfig& config, const Params& params, bool rear);

}  // namespace cairn::carmen_log
