#include "plugins/simulated_robot/sonar_ring.hpp"

#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

constexpr std::uint64_t kRangePurpose = 100;

std::vector<int> checked_order(const RobotModel& robot) {
  const int count = static_cast<int>(robot.sonars.size());
  std::vector<int> order = robot.firing_order;
  if (order.empty()) {
    order.resize(robot.sonars.size());
    std::iota(order.begin(), order.end(), 0);
  }
  for (const int sonar : order) {
    if (sonar < 0 || sonar >= count) {
      throw std::invalid_argument("simulated_robot: firing order names sonar " + std::to_string(sonar) + " of " +
                                  std::to_string(count));
    }
  }
  return order;
}

}  // namespace

SonarRing::SonarRing(const SimulatedRobotConfig& config, const RobotModel& robot, const Scene& scene,
                     std::uint64_t seed)
    : sonars_(robot.sonars),
      firing_order_(checked_order(robot)),
      fires_all_(config.fire_all || robot.firing_period_s <= 0.0),
      error_(in_truth(robot, config.truth).range_error),
      noise_(seed, kRangePurpose) {
  for (const SonarModel& sonar : in_truth(robot, config.truth).sonars)
    echoes_.emplace_back(config.echo, scene, sonar.half_beam_rad);
}

std::vector<RangeReading> SonarRing::fire(const Pose2& T_map_robot, std::int64_t tick) {
  std::vector<RangeReading> readings;
  if (fires_all_) {
    for (const int sonar : firing_order_) readings.push_back(read(T_map_robot, sonar));
  } else if (!firing_order_.empty()) {
    readings.push_back(read(T_map_robot, firing_order_[static_cast<std::size_t>(tick - 1) % firing_order_.size()]));
  }
  return readings;
}

RangeReading SonarRing::read(const Pose2& T_map_robot, int sonar) {
  const SonarModel& model = sonars_[static_cast<std::size_t>(sonar)];
  RangeReading reading{model.T_robot_sonar, model.half_beam_rad, model.min_m, model.max_m, 0.0, sonar};
  const std::optional<double> echo_m =
      echoes_[static_cast<std::size_t>(sonar)].first_echo(T_map_robot * model.T_robot_sonar, model.max_m);
  // As many draws for every reading, so that one lost echo does not change those that follow.
  const double noise = noise_.normal();
  const bool is_dropped = noise_.uniform() < error_.dropped_ratio;
  const bool is_crosstalk = noise_.uniform() < error_.crosstalk_ratio;
  const double elsewhere_m = model.min_m + noise_.uniform() * (model.max_m - model.min_m);
  constexpr double kNoEcho = std::numeric_limits<double>::infinity();
  double range_m = echo_m && !is_dropped ? *echo_m + (error_.noise_m + error_.noise_ratio * *echo_m) * noise : kNoEcho;
  if (is_crosstalk) range_m = elsewhere_m;
  reading.range_m = range_m < model.min_m ? -kNoEcho : range_m > model.max_m ? kNoEcho : range_m;
  return reading;
}

}  // namespace cairn
