// Lasers as logs know them: fans of narrow beams.
#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/observation.hpp"

namespace cairn::log_common {

// Where a laser sits and what it can see, for logs that do not say so themselves.
struct LaserConfig {
  std::optional<double> x_m;
  std::optional<double> y_m;
  std::optional<double> angle_rad;
  std::optional<double> first_angle_rad;
  std::optional<double> step_rad;
  double half_beam_rad = 0.0;
  double min_m = 0.05;
  std::optional<double> max_m;

  // The place on the robot that the log says, with what is set in its stead.
  [[nodiscard]] Pose2 placed(const Pose2& T_robot_said) const {
    return {x_m.value_or(T_robot_said.x_m), y_m.value_or(T_robot_said.y_m), angle_rad.value_or(T_robot_said.theta_rad)};
  }
  static void describe(Fields<LaserConfig>& fields);
};

inline constexpr double kUsualLaserMax_m = 80.0;

struct Fan {
  Pose2 T_robot_laser;
  double first_angle_rad = -0.5 * std::numbers::pi;
  double step_rad = 0.0;
  double max_m = kUsualLaserMax_m;
};

struct UsualAngles {
  double first_rad = 0.0;
  double step_rad = 0.0;
};

// Of the usual laser with so many beams: 180 and 181 are 1 deg apart from -90 deg on, 360 and 361 half a degree, 541
// half a degree from -135 deg on, ...; otherwise the beams are from -90 to 90 deg.
[[nodiscard]] UsualAngles usual_angles(std::size_t beams);

// Of a laser of which the log says nothing.
[[nodiscard]] Fan usual_fan(const LaserConfig& config, std::size_t beams);

// One reading a beam, without ranges, numbered from first_sensor; the settings win over the fan's angles.
[[nodiscard]] std::vector<RangeReading> readings_of(const Fan& fan, std::size_t beams, const LaserConfig& config,
                                                    int first_sensor);
// What distinguishes one fan from another.
[[nodiscard]] std::string key_of(const Fan& fan, std::size_t beams);

// Throws ConfigError, naming the file, when min_m is not less than max_m.
void check_limits(const std::filesystem::path& file, const std::string& what, double min_m, double max_m);
void check_limits(const std::filesystem::path& file, const std::string& what, const LaserConfig& config);

}  // namespace cairn::log_common
