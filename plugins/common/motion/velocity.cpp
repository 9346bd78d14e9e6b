#include "plugins/common/motion/velocity.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::motion {

Accelerations accelerations_of(const RobotModel& robot) {
  Accelerations limits{robot.max_acceleration_mps2, robot.max_turn_acceleration_radps2, 0.0};
  if (robot.kinematics == Kinematics::car) limits.min_turning_radius_m = robot.min_turning_radius_m;
  return limits;
}

Twist approached(const Twist& now, const Twist& target, double period_s, const Accelerations& limits) {
  Twist next{cairn::approached(now.v_mps, target.v_mps, limits.forward_mps2 * period_s),
             cairn::approached(now.w_radps, target.w_radps, limits.turn_radps2 * period_s)};
  if (limits.min_turning_radius_m > 0.0) {
    const double max_radps = std::abs(next.v_mps) / limits.min_turning_radius_m;
    next.w_radps = std::clamp(next.w_radps, -max_radps, max_radps);
  }
  return next;
}

void TurnSettings::describe(Fields<TurnSettings>& fields) {
  using C = TurnSettings;
  fields.number("gain_per_s", &C::gain_per_s, {0.1, 20.0}, "1/s", "turn rate for each radian of heading error");
  fields.angle("aimed_deg", &C::aimed_rad, {0.1, 20.0}, "a heading error within this is not corrected in place");
  fields.angle("max_degps", &C::max_radps, {1.0, 360.0},
               "fastest turn, within the robot's own limits; faster turns than a round of the sonars leave gaps in the "
               "map",
               "deg/s");
}

double max_turn_radps(const RobotModel& robot, const TurnSettings& settings) {
  return std::min(settings.max_radps, robot.max_w_radps);
}

Twist turn_by(double heading_error_rad, double max_w_radps, const TurnSettings& settings) {
  if (std::abs(heading_error_rad) <= settings.aimed_rad) return {};
  return {0.0, std::clamp(settings.gain_per_s * heading_error_rad, -max_w_radps, max_w_radps)};
}

}  // namespace cairn::motion
