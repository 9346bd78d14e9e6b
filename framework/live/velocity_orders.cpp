#include "framework/live/velocity_orders.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::live {
namespace {

double approached(double now, double wanted, double max, double most_growth) {
  wanted = std::clamp(wanted, -max, max);
  const bool is_same_way = now * wanted > 0.0;
  const double from = is_same_way ? std::abs(now) : 0.0;
  return std::copysign(std::min(std::abs(wanted), from + most_growth), wanted);
}

}  // namespace

Twist approached(const Twist& now, const Twist& wanted, double dt_s, const RobotModel& robot) {
  return {approached(now.v_mps, wanted.v_mps, robot.max_v_mps, robot.max_acceleration_mps2 * dt_s),
          approached(now.w_radps, wanted.w_radps, robot.max_w_radps, robot.max_turn_acceleration_radps2 * dt_s)};
}

}  // namespace cairn::live
