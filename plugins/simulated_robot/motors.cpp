#include "plugins/simulated_robot/motors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace cairn {
void Motors::command(const Twist& twist) {
  if (!std::isfinite(twist.v_mps) || !std::isfinite(twist.w_radps)) {
    throw std::invalid_argument("simulated_robot: command is not finite: v " + std::to_string(twist.v_mps) +
                                " m/s, w " + std::to_string(twist.w_radps) + " rad/s");
  }
  wanted_ = twist;
}

Twist Motors::turn(double for_s, bool has_power) {
  const Twist wanted = has_power ? wanted_ : Twist{};
  Twist next;
  next.v_mps = approached(twist_.v_mps, std::clamp(wanted.v_mps, -robot_.max_v_mps, robot_.max_v_mps),
                          robot_.max_acceleration_mps2 * for_s);
  next.w_radps = approached(twist_.w_radps, std::clamp(wanted.w_radps, -robot_.max_w_radps, robot_.max_w_radps),
                            robot_.max_turn_acceleration_radps2 * for_s);
  if (robot_.kinematics == Kinematics::car && robot_.min_turning_radius_m > 0.0) {
    const double tightest_radps = std::abs(next.v_mps) / robot_.min_turning_radius_m;
    next.w_radps = std::clamp(next.w_radps, -tightest_radps, tightest_radps);
  }
  // The mean of both ends is exact under constant acceleration.
  const Twist mean{0.5 * (twist_.v_mps + next.v_mps), 0.5 * (twist_.w_radps + next.w_radps)};
  twist_ = next;
  return mean;
}

}  // namespace cairn
