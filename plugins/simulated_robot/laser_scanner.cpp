#include "plugins/simulated_robot/laser_scanner.hpp"

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr std::uint64_t kLaserPurpose = 300;
constexpr double kOnTime = 1e-6;  // of a period: rounding

double scans_until(double time_s, double rate_hz) {
  return std::floor(time_s * rate_hz + kOnTime);
}

}  // namespace

double laser_tick_s(const RobotModel& robot, double tick_s) {
  const double period_s = reading_period_s(robot);
  return period_s / std::max(1.0, std::ceil(period_s / tick_s - kOnTime));
}

LaserScanners::LaserScanners(const RobotModel& robot, const Scene& scene, std::uint64_t seed) : scene_(scene) {
  for (std::size_t i = 0; i < robot.lasers.size(); ++i) {
    Scanner scanner{robot.lasers[i], first_beam_of(robot, i), {}, NoiseStream(seed, kLaserPurpose + i)};
    for (int beam = 0; beam < scanner.model.beams; ++beam)
      scanner.T_robot_beam.push_back(scanner.model.T_robot_beam(beam));
    scanners_.push_back(std::move(scanner));
  }
}

void LaserScanners::scan(const Pose2& T_map_robot, double before_s, double now_s, std::vector<RangeReading>& readings) {
  for (Scanner& scanner : scanners_)
    if (scans_until(now_s, scanner.model.rate_hz) > scans_until(before_s, scanner.model.rate_hz))
      scan(scanner, T_map_robot, readings);
}

void LaserScanners::scan(Scanner& scanner, const Pose2& T_map_robot, std::vector<RangeReading>& readings) {
  constexpr double kNoEcho = std::numeric_limits<double>::infinity();
  const LaserModel& model = scanner.model;
  const Pose2 T_map_laser = T_map_robot * model.T_robot_laser;
  distances_m_.resize(static_cast<std::size_t>(model.beams));
  scene_.cast_fan(
      {T_map_laser.position(), T_map_laser.theta_rad + model.first_angle_rad, model.step_rad(), model.max_m},
      distances_m_);
  readings.reserve(readings.size() + distances_m_.size());
  for (std::size_t i = 0; i < distances_m_.size(); ++i) {
    // As many draws for every beam, so that one lost echo does not change those that follow.
    const double noise = scanner.noise.normal();
    const bool is_dropped = model.dropped_ratio > 0.0 && scanner.noise.uniform() < model.dropped_ratio;
    const double at_m = distances_m_[i];
    double range_m =
        std::isinf(at_m) || is_dropped ? kNoEcho : at_m + (model.noise_m + model.noise_ratio * at_m) * noise;
    if (range_m > model.max_m) range_m = kNoEcho;
    if (range_m < model.min_m) range_m = -kNoEcho;
    readings.push_back(
        {scanner.T_robot_beam[i], 0.0, model.min_m, model.max_m, range_m, scanner.first_beam + static_cast<int>(i)});
  }
}

}  // namespace cairn
