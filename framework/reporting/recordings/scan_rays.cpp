#include "framework/reporting/recordings/scan_rays.hpp"

#include <cmath>

namespace cairn {

std::size_t rays_of_a_scan(std::span<const RangeReading> ranges) {
  constexpr double kEven_rad = 1e-9;
  const auto continues = [&](std::size_t i) {
    const RangeReading& ray = ranges[i];
    if (ray.half_beam_rad != 0.0 || ray.max_m != ranges[0].max_m) return false;
    if (ray.T_robot_sensor.position() != ranges[0].T_robot_sensor.position()) return false;
    if (i < 2) return true;
    const double step_rad = ranges[1].T_robot_sensor.theta_rad - ranges[0].T_robot_sensor.theta_rad;
    const double here_rad = ray.T_robot_sensor.theta_rad - ranges[i - 1].T_robot_sensor.theta_rad;
    return std::abs(wrap_angle(here_rad - step_rad)) <= kEven_rad;
  };
  std::size_t count = 0;
  while (count < ranges.size() && continues(count)) ++count;
  return count;
}

}  // namespace cairn
