// Velocities within the robot's limits.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::motion {

struct Accelerations {
  double forward_mps2 = 0.5;
  double turn_radps2 = 3.5;
  double min_turning_radius_m = 0.0;  // > 0: a car
};
[[nodiscard]] Accelerations accelerations_of(const RobotModel& robot);

// One tick's change of velocity towards the target, within the accelerations.
[[nodiscard]] Twist approached(const Twist& now, const Twist& target, double period_s, const Accelerations& limits);

// How the robot turns in place by an angle.
struct TurnSettings {
  double gain_per_s = 2.0;
  double aimed_rad = radians(2.0);
  double max_radps = radians(50.0);
  static void describe(Fields<TurnSettings>& fields);
};
// At most settings.max_radps and the robot's own.
[[nodiscard]] double max_turn_radps(const RobotModel& robot, const TurnSettings& settings);
// Turning in place by heading_error_rad (anticlockwise positive); no turn when it is aimed.
[[nodiscard]] Twist turn_by(double heading_error_rad, double max_w_radps, const TurnSettings& settings = {});

}  // namespace cairn::motion
