// A Player log (file version 0.3) played back. Plugin `player_log`, kind sensor; nothing to drive.
//
// Lines: `time host robot interface index type subtype payload`. Read are position2d 1:1 (odometry),
// sonar 1:1 (ranges), 1:2 and 4:1 (where the transducers sit), laser 1:1 (a scan with intensities), 1:2
// (the same with a pose, which is not used) and 4:1 (where it sits), ranger 1:1, 1:2, 4:1 and 4:5 as lasers (30 ranges
// or more). Each line with ranges is one observation at the odometry of the last position2d line before it, or else of
// the first. Without a sonar geometry so far, the robot file's sonars serve when they are as many.
// Comments (#) say nothing, all other lines are counted, as interface:type:subtype.
//
// Bad lines, refused at their file:line:column or skipped and counted: a number that is none, a count
// that does not fit the line, a pose beyond 100 km, more than 1 MiB in a line, damaged
// compression, sonar ranges without a geometry. Another file version is
// refused in any case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "plugins/common/logs/laser.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::player_log {

struct SonarConfig {
  double half_beam_rad = radians(15.0);
  double min_m = 0.1;
  double max_m = 5.0;

  static void describe(Fields<SonarConfig>& fields);
};

struct Config : log_common::LogRules {
  std::filesystem::path file;
  std::vector<std::string> interfaces;
  int position_index = 0;
  int sonar_index = 0;
  int laser_index = 0;
  SonarConfig sonar;
  log_common::LaserConfig laser;

  static void describe(Fields<Config>& fields);
};

// Reads the whole log. Throws ConfigError for what is refused and for a log without an observation.
[[nodiscard]] log_common::ScanLog read_player_log(const Config& config, const RobotModel& robot,
                                                  const Budget& budget = {});

}  // namespace cairn::player_log
