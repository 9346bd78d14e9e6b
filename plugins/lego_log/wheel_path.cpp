#include "plugins/lego_log/wheel_path.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::lego_log {

void Wheels::describe(Fields<Wheels>& fields) {
  fields.number("m_per_tick", &Wheels::m_per_tick, {1e-9, 1.0}, "m", "distance of a wheel a tick");
  fields.number("axle_m", &Wheels::axle_m, {0.001, 100.0}, "m", "between the wheels");
}

Pose2 WheelPath::arc(double left_ticks, double right_ticks) const {
  const double way_m = 0.5 * (left_ticks + right_ticks) * wheels_.m_per_tick;
  const double turn_rad = (right_ticks - left_ticks) * wheels_.m_per_tick / wheels_.axle_m;
  const double half_rad = 0.5 * turn_rad;
  const double chord_m = std::abs(half_rad) < 1e-6 ? way_m : way_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), wrap_angle(turn_rad)};
}

void WheelPath::add(double stamp_s, double left_ticks, double right_ticks) {
  Step step{stamp_s, left_ticks, right_ticks, {}};
  if (!steps_.empty()) {
    const Step& last = steps_.back();
    step.T_first_robot = last.T_first_robot * arc(left_ticks - last.left_ticks, right_ticks - last.right_ticks);
  }
  steps_.push_back(step);
}

Pose2 WheelPath::at(double stamp_s) const {
  const auto after = std::upper_bound(steps_.begin(), steps_.end(), stamp_s,
                                      [](double stamp, const Step& step) { return stamp < step.stamp_s; });
  if (after == steps_.begin()) return steps_.front().T_first_robot;
  if (after == steps_.end()) return steps_.back().T_first_robot;
  const Step& before = *std::prev(after);
  const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
  return before.T_first_robot *
         arc(share * (after->left_ticks - before.left_ticks), share * (after->right_ticks - before.right_ticks));
}

}  // namespace cairn::lego_log
