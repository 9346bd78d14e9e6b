#include "plugins/sonar_from_laser/sonar_from_laser.hpp"

#include <algorithm>
#include <stdexcept>

#include "plugins/common/logs/derived_sonar.hpp"

namespace cairn::sonar_from_laser {
void Config::describe(Fields<Config>& fields) {
  fields.plugin("source", &Config::source, "sensor", "the sensor with the laser scans").required = true;
}

SonarFromLaser::SonarFromLaser(std::shared_ptr<Sensor> source, std::vector<SonarModel> sonars)
    : source_(std::move(source)), sonars_(std::move(sonars)) {
  if (sonars_.empty()) throw std::invalid_argument("the robot file has no sonars to derive readings for");
}

SensorStep SonarFromLaser::next(const Budget& budget) {
  SensorStep step = source_->next(budget);
  if (step.state != SensorState::observation) {
    step.reason = "sonar readings derived from laser scans: " + step.reason;
    return step;
  }
  double seen_m = 0.0;  // no silence reaches further than the laser does
  for (const RangeReading& beam : step.observation.ranges) seen_m = std::max(seen_m, beam.max_m);
  std::vector<RangeReading> readings;
  readings.reserve(sonars_.size());
  for (std::size_t i = 0; i < sonars_.size(); ++i) {
    const SonarModel& sonar = sonars_[i];
    const std::optional<double> range_m = log_common::derived_range(sonar, step.observation.ranges);
    if (!range_m) continue;
    readings.push_back({sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, std::min(sonar.max_m, seen_m), *range_m,
                        static_cast<int>(i)});
  }
  step.observation.ranges = std::move(readings);
  return step;
}

}  // namespace cairn::sonar_from_laser
