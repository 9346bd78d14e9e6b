// Laser scans with poses in a JSON file, played back. Plugin `json_log`, kind sensor; nothing to drive.
//
//   {"map": {"976052890.244111": {"range": [1.09, ...], "x": 0.6, "y": -0.03, "theta": -0.35}, ...}}
//
// One observation a stamp, in order of time; x, y, theta is the laser's pose, the robot's is the laser's
// less its offset. A scan without a pose is taken at that of the one before. NaN, Infinity and null are ranges too.
// Bad scans (no "range", a number that is none, a stamp that is none, a pose beyond 100 km) are refused, naming file
// and stamp, or skipped and counted. Text that is no JSON is refused at its line and column; when bad lines are
// skipped, the scans before it count.
#pragma once

#include <filesystem>

#include "plugins/common/logs/laser.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::json_log {

struct Config : log_common::LogRules {
  std::filesystem::path file;
  log_common::LaserConfig laser;

  static void describe(Fields<Config>& fields);
};

// Throws ConfigError for what is refused and for a log without an observation.
[[nodiscard]] log_common::ScanLog read_json_log(const Config& config, const Budget& budget = {});

}  // namespace cairn::json_log
