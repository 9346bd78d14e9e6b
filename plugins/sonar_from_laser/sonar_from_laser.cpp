#include "plugins/sonar_from_laser/sonar_from_laser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace cairn::sonar_from_laser {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_in_cone(const SonarModel& sonar, const Point& p_sonar) {
  return std::abs(std::atan2(p_sonar.y(), p_sonar.x())) <= sonar.half_beam_rad;
}

// Where a beam without an echo leaves the disc of the sonar's reach, in sonar coordinates; nothing when
// it begins outside and does not look there.
std::optional<Point> exit_point(const Pose2& T_sonar_beam, double reach_m) {
  const Point begin = T_sonar_beam.position();
  const double along = begin.dot(T_sonar_beam.direction());
  const double inside = along * along - begin.squaredNorm() + reach_m * reach_m;
  if (inside < 0.0) return std::nullopt;
  const double distance_m = -along + std::sqrt(inside);
  if (distance_m < 0.0) return std::nullopt;
  return Point(begin + distance_m * T_sonar_beam.direction());
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.plugin("source", &Config::source, "sensor", "the sensor with the laser scans").required = true;
}

std::optional<double> derived_range(const SonarModel& sonar, const std::vector<RangeReading>& beams) {
  const Pose2 T_sonar_robot = inverse(sonar.T_robot_sonar);
  double nearest_m = kInfinity;
  bool sees = false;
  for (const RangeReading& beam : beams) {
    if (std::isnan(beam.range_m) || beam.range_m < beam.min_m) continue;
    const Pose2 T_sonar_beam = T_sonar_robot * beam.T_robot_sensor;
    const bool echo = beam.range_m < beam.max_m;
    if (echo) {
      const Point p_sonar = T_sonar_beam * Point(beam.range_m, 0.0);
      if (is_in_cone(sonar, p_sonar)) {
        sees = true;
        nearest_m = std::min(nearest_m, p_sonar.norm());
      }
    } else if (const auto exit = exit_point(T_sonar_beam, std::min(sonar.max_m, beam.max_m))) {
      sees = sees || is_in_cone(sonar, *exit);
    }
  }
  if (!sees) return std::nullopt;
  if (nearest_m < sonar.min_m) return -kInfinity;
  return nearest_m > sonar.max_m ? kInfinity : nearest_m;
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
    const std::optional<double> range_m = derived_range(sonar, step.observation.ranges);
    if (!range_m) continue;
    readings.push_back({sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, std::min(sonar.max_m, seen_m), *range_m,
                        static_cast<int>(i)});
  }
  step.observation.ranges = std::move(readings);
  return step;
}

}  // namespace cairn::sonar_from_laser
