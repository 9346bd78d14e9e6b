// Laser scans and wheel counts of a small two-wheeled robot, played back. Plugin `lego_log`, kind sensor;
// nothing to drive.
//
//   scans:   S STAMP_MS COUNT RANGE_MM ...
//   motors:  M STAMP_MS LEFT_TICKS . . . RIGHT_TICKS ...      (the third and the seventh word)
//
// One observation a scan. Its odometry is that of the wheels at the scan's time, between two lines of the
// motors as far along the arc as the time is. The log knows no place in a map: the mission's `start` says
// where the robot begins. Bad lines (a number that is none, a count that does not fit the line, a scan of
// another size than the first, ticks or ranges beyond all bounds, motor lines that go back in time) are
// refused at file:line:column, or skipped and counted; lines of other kinds are counted.
#pragma once

#include <filesystem>

#include "plugins/common/logs/laser.hpp"
#include "plugins/common/logs/scan_log.hpp"
#include "plugins/lego_log/wheel_path.hpp"

namespace cairn::lego_log {

struct Config : log_common::LogRules {
  std::filesystem::path file;
  std::filesystem::path motors;
  Wheels wheels;
  log_common::LaserConfig laser;
  double range_ratio = 1.0;
  double range_offset_m = 0.0;

  static void describe(Fields<Config>& fields);
};

// start_heading_rad: of the robot at the first scan, for compass_from_pose.
// Throws ConfigError for what is refused, for motors without a line and for a log without a scan.
[[nodiscard]] log_common::ScanLog read_lego_log(const Config& config, double start_heading_rad,
                                                const Budget& budget = {});

}  // namespace cairn::lego_log
