#include "plugins/simulated_robot/motors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace cairn {

void Motors::command(const Twist& twist, double valid_for_s) {
  if (!is_finite(twist) || !std::isfinite(valid_for_s)) {
    throw std::invalid_argument("simulated_robot: command is not finite: v " + std::to_string(twist.v_mps) +
                                " m/s, w " + std::to_string(twist.w_radps) + " rad/s, for " +
                                std::to_string(valid_for_s) + " s");
  }
  wanted_ = twist;
  valid_for_s_ = valid_for_s;
  is_new_command_ = true;
  is_stopped_.store(false, std::memory_order_relaxed);
}

Twist Motors::turn(double for_s, bool has_power) {
  constexpr double kRounding_s = 1e-9;
  const bool is_new_command = std::exchange(is_new_command_, false);
  const bool is_stopped = is_stopped_.load(std::memory_order_relaxed) && !is_new_command;
  const bool counts = valid_for_s_ > kRounding_s && !is_stopped;
  valid_for_s_ -= for_s;
  const Twist wanted = counts && has_power ? wanted_ : Twist{};
  const double ratio = counts ? 1.0 : emergency_ratio_;
  Twist next;
  next.v_mps = approached(twist_.v_mps, std::clamp(wanted.v_mps, -robot_.max_v_mps, robot_.max_v_mps),
                          ratio * robot_.max_acceleration_mps2 * for_s);
  next.w_radps = approached(twist_.w_radps, std::clamp(wanted.w_radps, -robot_.max_w_radps, robot_.max_w_radps),
                            ratio * robot_.max_turn_acceleration_radps2 * for_s);
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
