#include "plugins/submap_graph/compass_headings.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::submap_graph {
namespace {

constexpr double kGroup_m = 2.0;        // of way, with one local bias
constexpr double kScales = 2.0;         // a bias of places comes back: on the way it is known for longer
constexpr double kBoundToSigma = 0.63;  // of a bias that the robot's file gives a bound of
constexpr double kLimit_sigmas = 1.5;   // beyond which a reading counts less and less
constexpr double kStartHeading_rad = radians(0.5);

double information_of(double sigma_rad) {
  return 1.0 / (sigma_rad * sigma_rad);
}

}  // namespace

Compass compass_of(const Config& config, const RobotModel& robot) {
  if (!config.use_compass || !robot.has_compass) return {};
  const CompassError& error = robot.compass_error;
  return {std::max(config.min_compass_noise_rad, error.noise_rad), config.compass_bias_rad,
          std::max(config.min_compass_local_bias_rad, kBoundToSigma * error.local_bias_rad),
          kScales * std::max(0.1, error.local_bias_scale_m)};
}

void CompassHeadings::add(std::optional<double> compass_rad, double step_m, TiedGraph& graph) {
  in_group_m_ += step_m;
  if (compass_.noise_rad <= 0.0 || !compass_rad || !std::isfinite(*compass_rad)) return;
  if (!has_begun_) {
    // The compass has a bias; where the map's axes lie is known by the pose at the start, or by a map that is held.
    if (graph.held() == 0) graph.add_heading({0, graph.T_map(0).theta_rad, information_of(kStartHeading_rad)});
    graph.expect_compass(compass_.bias_rad, compass_.local_bias_rad, std::exp(-kGroup_m / compass_.local_scale_m));
    has_begun_ = true;
    in_group_m_ = 0.0;
  } else if (in_group_m_ >= kGroup_m) {
    ++group_;
    in_group_m_ = 0.0;
  }
  graph.add_heading({graph.size() - 1, *compass_rad, information_of(compass_.noise_rad), group_, kLimit_sigmas});
}

}  // namespace cairn::submap_graph
