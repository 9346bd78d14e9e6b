// Settings of the CARMEN log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/common/logs/laser.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::carmen_log {

enum class Poses { log, odometry };

struct SonarConfig {
  std::optional<double> half_beam_rad;
  double min_m = 0.1;
  double max_m = 5.0;

  static void describe(Fields<SonarConfig>& fields);
};

struct Config : log_common::LogRules {
  std::filesystem::path file;
  std::vector<std::string> lines;
  Poses poses = Poses::log;
  log_common::LaserConfig laser;
  log_common::LaserConfig rear_laser;
  SonarConfig sonar;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::carmen_log
