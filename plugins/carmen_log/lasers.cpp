#include "plugins/carmen_log/lasers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::carmen_log {
namespace {

using log_common::LogLine;

[[noreturn]] void refuse_count(const LogLine& line, std::size_t at, std::size_t n, std::size_t rest) {
  throw ConfigError(line.place(at), std::to_string(n) + " ranges, says the line, but " +
                                        std::to_string(line.size() - std::min(line.size(), at + 1)) +
                                        " words follow, not " + std::to_string(n + rest));
}

double param(const Params& params, std::string_view name, double otherwise) {
  const auto at = params.find(name);
  double value = 0.0;
  if (at == params.end() || !log_common::read_number(at->second, value) || !std::isfinite(value)) return otherwise;
  return value;
}

constexpr double kCentimetre_m = 0.01;
constexpr double kFarthestMount_m = 10.0;  // no laser sits further from its robot's centre

double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

double max_of_laser(const LaserLine& line, const log_common::LaserConfig& config, const Params& params, bool rear) {
  constexpr double kUsual_m = log_common::kUsualLaserMax_m;
  double max_m = config.max_m.value_or(kUsual_m);
  if (!config.max_m && line.says_fan) max_m = line.max_m;
  if (!config.max_m && !line.says_fan)
    max_m = param(params, rear ? "robot_rear_laser_max" : "robot_front_laser_max", kUsual_m);
  return max_m > config.min_m && max_m <= log_common::kFarthest_m ? max_m : std::max(kUsual_m, 2.0 * config.min_m);
}

// type start_angle field step max accuracy remission_mode n
void read_fan(const LogLine& line, LaserLine& laser) {
  laser.says_fan = true;
  laser.first_angle_rad = line.finite(2, "start angle");
  laser.step_rad = line.finite(4, "angular resolution");
  laser.max_m = line.metres(5, "maximum range");
  laser.ranges = line.count(8, "count of ranges");
  laser.first_range = 9;
  if (std::abs(laser.first_angle_rad) > 2.0 * std::numbers::pi || std::abs(laser.step_rad) > std::numbers::pi)
    throw ConfigError(line.place(2), "angles of beams are radians, a turn at most");
  if (laser.max_m <= 0.0) throw ConfigError(line.place(5), "the maximum range must be above 0");
}

}  // namespace

LaserLine read_flaser(const LogLine& line) {
  constexpr std::size_t kBehind = 9;         // two poses, time host time
  constexpr std::size_t kBehindAtLeast = 7;  // old logs have no host, or one time
  LaserLine laser;
  laser.has_both = true;
  laser.ranges = line.count(1, "count of ranges");
  laser.first_range = 2;
  const std::size_t behind = laser.first_range + laser.ranges;
  // A count that does not fit moves other words to where the poses must be.
  double number = 0.0;
  const bool is_short = line.size() >= behind + kBehindAtLeast && line.size() < behind + kBehind &&
                        log_common::read_number(line.word(behind + kBehindAtLeast - 1), number);
  if (line.size() != behind + kBehind && !is_short) refuse_count(line, 1, laser.ranges, kBehind);
  laser.T_log_laser = line.pose(behind);
  laser.T_odom_robot = line.pose(behind + 3);
  laser.stamp_s = line.finite(behind + 6, "time");
  return laser;
}

LaserLine read_robotlaser(const LogLine& line) {
  constexpr std::size_t kBehindOld = 13;  // two poses, two speeds, two distances, time host time
  constexpr std::size_t kBehindNew = 14;  // and the turn axis
  LaserLine laser;
  read_fan(line, laser);
  laser.has_both = true;
  laser.says_place = true;
  std::size_t behind = laser.first_range + laser.ranges;
  if (line.size() != behind + kBehindOld) {
    if (line.size() <= behind) refuse_count(line, 8, laser.ranges, kBehindOld);
    const std::size_t remissions = line.count(behind, "count of remissions");
    if (line.size() != behind + 1 + remissions + kBehindNew)
      refuse_count(line, 8, laser.ranges, 1 + remissions + kBehindNew);
    behind += 1 + remissions;
  }
  laser.T_log_laser = line.pose(behind);
  laser.T_odom_robot = line.pose(behind + 3);
  laser.stamp_s = line.finite(line.size() - 3, "time");
  return laser;
}

LaserLine read_laser_reading(const LogLine& line) {
  constexpr std::size_t kBehind = 4;
  LaserLine laser;
  laser.ranges = line.count(1, "count of ranges");
  laser.first_range = 2;
  const std::size_t behind = laser.first_range + laser.ranges;
  if (line.size() != behind + kBehind) refuse_count(line, 1, laser.ranges, kBehind);
  laser.T_log_laser = laser.T_odom_robot = line.pose(behind);
  laser.stamp_s = line.finite(behind + 3, "time");
  return laser;
}

LaserLine read_l_line(const LogLine& line) {
  constexpr std::size_t kBefore = 7;
  if (line.size() <= kBefore + 1) throw ConfigError(line.place(line.size()), "the line ends before its ranges");
  LaserLine laser;
  laser.unit_m = kCentimetre_m;
  laser.says_place = true;
  laser.first_range = kBefore;
  laser.ranges = line.size() - kBefore - 1;
  laser.T_odom_robot = pose_in_cm(line, 1);
  laser.T_log_laser = pose_in_cm(line, 4);
  laser.stamp_s = line.finite(line.size() - 1, "time");
  return laser;
}

Pose2 pose_in_cm(const LogLine& line, std::size_t first_word) {
  const Pose2 pose = line.pose(first_word);
  return {kCentimetre_m * pose.x_m, kCentimetre_m * pose.y_m, pose.theta_rad};
}

LaserLine read_rawlaser(const LogLine& line) {
  constexpr std::size_t kBehind = 3;  // time host time
  LaserLine laser;
  read_fan(line, laser);
  const std::size_t behind = laser.first_range + laser.ranges;
  if (line.size() <= behind) refuse_count(line, 8, laser.ranges, 1 + kBehind);
  const std::size_t remissions = line.count(behind, "count of remissions");
  if (line.size() != behind + 1 + remissions + kBehind) refuse_count(line, 8, laser.ranges, 1 + remissions + kBehind);
  laser.stamp_s = line.finite(line.size() - 3, "time");
  return laser;
}

Pose2 said_place(const LaserLine& line, const Params& params, bool rear) {
  if (line.says_place) {
    const Pose2 exact = inverse(line.T_odom_robot) * line.T_log_laser;
    if (exact.position().norm() <= kFarthestMount_m)
      return {rounded(exact.x_m), rounded(exact.y_m), rounded(exact.theta_rad)};
  }
  const double offset_m = param(params, rear ? "robot_rearlaser_offset" : "robot_frontlaser_offset", 0.0);
  return {std::abs(offset_m) <= kFarthestMount_m ? offset_m : 0.0, 0.0, rear ? std::numbers::pi : 0.0};
}

log_common::Fan fan_of(const LaserLine& line, const Pose2& T_robot_laser, const log_common::LaserConfig& config,
                       const Params& params, bool rear) {
  log_common::Fan fan;
  fan.T_robot_laser = T_robot_laser;
  fan.max_m = max_of_laser(line, config, params, rear);
  const log_common::UsualAngles usual = log_common::usual_angles(line.ranges);
  fan.first_angle_rad = line.says_fan ? line.first_angle_rad : usual.first_rad;
  fan.step_rad = line.says_fan ? line.step_rad : usual.step_rad;
  return fan;
}

}  // namespace cairn::carmen_log
