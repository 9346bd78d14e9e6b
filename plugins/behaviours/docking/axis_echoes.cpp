#include "plugins/behaviours/docking/axis_echoes.hpp"

#include <algorithm>
#include <vector>

namespace cairn::behaviours {

// Each echo of the transducers that look ahead, as a place on the axis. A range is to the nearest thing in the beam,
// and the distance that is wanted is to the nearest point of the landmark, too: no bearing is needed.
void AxisEchoes::see(const WorldView& world, const DockAxis& axis, double mapped_m) {
  if (world.observation == nullptr) return;
  double straightest_rad = settings_.straight_rad;
  for (const SonarModel& sonar : world.robot.sonars)
    straightest_rad = std::min(straightest_rad, std::abs(sonar.T_robot_sonar.theta_rad));
  const double robot_m = axis.along_m(world.pose.T_map_robot.position());
  for (const RangeReading& reading : world.observation->ranges) {
    if (!(std::abs(reading.T_robot_sensor.theta_rad) <= straightest_rad + settings_.same_rad)) continue;
    const double echo_m = robot_m - (reading.T_robot_sensor.x_m + reading.range_m);
    if (std::isnan(echo_m)) continue;
    if (echo_m > mapped_m + settings_.before_m) {
      if (between_since_s_) continue;
      between_since_s_ = world.time_s;
      between_sensor_ = reading.sensor;
      continue;
    }
    if (reading.sensor == between_sensor_) between_since_s_.reset();
    if (echo_m < settings_.past_m) continue;  // or no echo
    echoes_m_.push_back(echo_m);
    if (static_cast<int>(echoes_m_.size()) > settings_.echoes) echoes_m_.pop_front();
  }
}

std::optional<double> AxisEchoes::outline_m() const {
  if (static_cast<int>(echoes_m_.size()) < settings_.min_echoes) return std::nullopt;
  std::vector<double> sorted(echoes_m_.begin(), echoes_m_.end());
  std::ranges::sort(sorted);
  return sorted[sorted.size() / 2];
}

}  // namespace cairn::behaviours
