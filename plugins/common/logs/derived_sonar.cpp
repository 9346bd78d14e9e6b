#include "plugins/common/logs/derived_sonar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::log_common {
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

std::vector<SonarModel> ring_for(const std::vector<RangeReading>& beams, int count, double half_beam_rad,
                                 double max_m) {
  std::vector<SonarModel> ring;
  if (beams.empty()) return ring;
  const Pose2& first = beams.front().T_robot_sensor;
  double field_rad = 0.0;
  for (std::size_t i = 1; i < beams.size(); ++i)
    field_rad += wrap_angle(beams[i].T_robot_sensor.theta_rad - beams[i - 1].T_robot_sensor.theta_rad);
  for (int i = 0; i < count; ++i) {
    SonarModel sonar;
    sonar.T_robot_sonar = {first.x_m, first.y_m, wrap_angle(first.theta_rad + (i + 0.5) / count * field_rad)};
    sonar.half_beam_rad = half_beam_rad;
    sonar.max_m = max_m;
    ring.push_back(sonar);
  }
  return ring;
}

}  // namespace cairn::log_common
