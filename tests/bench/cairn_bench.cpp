// Speed of the inner loops, each beside its plain version in the same run: ratios are what counts.

#include <benchmark/benchmark.h>

#include "framework/contracts/module.hpp"
#include "plugins/baselines/bayes_map/bayes_map.hpp"

namespace cairn {
namespace {

// One sonar reading of a 30 degree cone into OG1 (range 2 m, or no echo within 5 m).
void integrate_reading(benchmark::State& state) {
  bayes_map::BayesMap map(bayes_map::Config{});
  Observation observation;
  RangeReading reading;
  reading.half_beam_rad = radians(15.0);
  reading.min_m = 0.1;
  reading.max_m = 5.0;
  reading.range_m = static_cast<double>(state.range(0));
  observation.ranges = {reading};
  PoseEstimate pose;
  for (auto _ : state) {
    pose.T_map_robot.theta_rad = wrap_angle(pose.T_map_robot.theta_rad + 0.1);
    benchmark::DoNotOptimize(map.integrate(observation, pose));
  }
}
BENCHMARK(integrate_reading)->Arg(2)->Arg(5);

}  // namespace
}  // namespace cairn
