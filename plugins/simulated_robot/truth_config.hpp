// How the robot that drives differs from the one that its file describes. The host and all other modules keep to the
// file, so that what is measured is what a wrong or worn description costs.
#pragma once

#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn {

struct TrueOdometry {
  std::optional<double> distance_ratio;
  std::optional<double> distance_bias_ratio;
  std::optional<double> heading_rad_per_m;

  static void describe(Fields<TrueOdometry>& fields) {
    fields.number("distance_ratio", &TrueOdometry::distance_ratio, {0.0, 1.0}, "", "as in the robot's file");
    fields.number("distance_bias_ratio", &TrueOdometry::distance_bias_ratio, {0.0, 1.0}, "", "as in the robot's file");
    fields.angle("heading_deg_per_m", &TrueOdometry::heading_rad_per_m, {0.0, 90.0}, "as in the robot's file", "deg/m");
  }
};

struct TrueCompass {
  std::optional<double> noise_rad;
  std::optional<double> local_bias_rad;
  std::optional<double> local_bias_scale_m;

  static void describe(Fields<TrueCompass>& fields) {
    fields.angle("noise_deg", &TrueCompass::noise_rad, {0.0, 180.0}, "as in the robot's file");
    fields.angle("local_bias_deg", &TrueCompass::local_bias_rad, {0.0, 180.0}, "as in the robot's file");
    fields.number("local_bias_scale_m", &TrueCompass::local_bias_scale_m, {0.01, 1000.0}, "m",
                  "as in the robot's file");
  }
};

struct TrueRanges {
  std::optional<double> noise_m;
  std::optional<double> noise_ratio;
  std::optional<double> dropped_ratio;
  std::optional<double> crosstalk_ratio;

  static void describe(Fields<TrueRanges>& fields) {
    fields.number("noise_m", &TrueRanges::noise_m, {0.0, 10.0}, "m", "as in the robot's file");
    fields.number("noise_ratio", &TrueRanges::noise_ratio, {0.0, 1.0}, "", "as in the robot's file");
    fields.number("dropped_ratio", &TrueRanges::dropped_ratio, {0.0, 1.0}, "", "as in the robot's file");
    fields.number("crosstalk_ratio", &TrueRanges::crosstalk_ratio, {0.0, 1.0}, "", "as in the robot's file");
  }
};

// What is left out is as in the robot's file.
struct TruthConfig {
  std::optional<double> half_beam_rad;  // of every sonar
  TrueOdometry odometry;
  TrueCompass compass;
  TrueRanges ranges;

  static void describe(Fields<TruthConfig>& fields) {
    fields.angle("half_beam_deg", &TruthConfig::half_beam_rad, {0.0, 90.0},
                 "of every sonar's beam; its readings still state the file's");
    fields.group("odometry", &TruthConfig::odometry, "errors of its dead reckoning");
    fields.group("compass", &TruthConfig::compass, "errors of its compass");
    fields.group("ranges", &TruthConfig::ranges, "errors of its ranges");
  }
};

// The robot that drives.
[[nodiscard]] inline RobotModel in_truth(const RobotModel& described, const TruthConfig& truth) {
  RobotModel robot = described;
  const auto put = [](double& to, const std::optional<double>& from) { to = from.value_or(to); };
  for (SonarModel& sonar : robot.sonars) put(sonar.half_beam_rad, truth.half_beam_rad);
  put(robot.odometry_error.distance_ratio, truth.odometry.distance_ratio);
  put(robot.odometry_error.distance_bias_ratio, truth.odometry.distance_bias_ratio);
  put(robot.odometry_error.heading_rad_per_m, truth.odometry.heading_rad_per_m);
  put(robot.compass_error.noise_rad, truth.compass.noise_rad);
  put(robot.compass_error.local_bias_rad, truth.compass.local_bias_rad);
  put(robot.compass_error.local_bias_scale_m, truth.compass.local_bias_scale_m);
  put(robot.range_error.noise_m, truth.ranges.noise_m);
  put(robot.range_error.noise_ratio, truth.ranges.noise_ratio);
  put(robot.range_error.dropped_ratio, truth.ranges.dropped_ratio);
  put(robot.range_error.crosstalk_ratio, truth.ranges.crosstalk_ratio);
  return robot;
}

}  // namespace cairn
