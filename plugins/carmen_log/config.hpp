// Settings of the CARMEN log.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/log_common/scan_log.hpp"

namespace cairn::carmen_log {

enum class Poses { log, odometry };
enum class NoEcho { silence, nothing };

// Where a laser sits and what it can see, for lines that do not say so themselves.
struct LaserConfig {
  std::optional<double> x_m;
  double y_m = 0.0;
  std::optional<double> angle_rad;
  std::optional<double> first_angle_rad;
  std::optional<double> step_rad;
  double half_beam_rad = 0.0;
  double min_m = 0.05;
  std::optional<double> max_m;

  static void describe(Fields<LaserConfig>& fields);
};

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
  std::vector<double> no_echo;
  NoEcho no_echo_means = NoEcho::silence;
  LaserConfig laser;
  LaserConfig rear_laser;
  SonarConfig sonar;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::carmen_log
