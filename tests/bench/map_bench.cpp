// Speed of the maps: MURIEL fast and plain side by side in the same run, and plain Bayes. Ratios are what counts.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <chrono>
#include <cmath>

#include "plugins/baselines/bayes_map/bayes_map.hpp"
#include "plugins/muriel/muriel.hpp"
#include "plugins/muriel/plain_muriel.hpp"

namespace cairn {
namespace {

// A robot that drives along a circle of 1 m in a round room with its wall `range_m` from it: poses change with
// each reading; the map is full, and so the logs after some orbits: no step of the fast evaluation takes a shorter way
// for that.
class Drive {
 public:
  Drive(double half_beam_rad, double range_m, int beams, double fan_rad) {
    for (int i = 0; i < beams; ++i) {
      RangeReading reading;
      reading.T_robot_sensor.theta_rad = beams > 1 ? fan_rad * (i / (beams - 1.0) - 0.5) : 0.0;
      reading.half_beam_rad = half_beam_rad;
      reading.min_m = 0.1;
      reading.max_m = 5.0;
      reading.range_m = range_m;
      observation_.ranges.push_back(reading);
    }
  }
  const Observation& observation() const { return observation_; }
  const PoseEstimate& next_pose() {
    angle_rad_ = wrap_angle(angle_rad_ + 0.1);
    pose_.T_map_robot = {std::cos(angle_rad_), std::sin(angle_rad_), angle_rad_};
    return pose_;
  }

 private:
  Observation observation_;
  PoseEstimate pose_;
  double angle_rad_ = 0.0;
};

template <class Map>
void integrate(benchmark::State& state, Drive drive, Map map) {
  for (int i = 0; i < 200; ++i) map.integrate(drive.observation(), drive.next_pose());
  for (auto _ : state) benchmark::DoNotOptimize(map.integrate(drive.observation(), drive.next_pose()));
  state.SetItemsProcessed(state.iterations());
}

Drive one_sonar() {
  return {radians(15.0), 2.0, 1, 0.0};
}
Drive laser_scan() {
  return {0.0, 2.0, 180, radians(180.0)};
}

// One reading of a 30 degree cone with an echo at 2 m, cells of 0.05 m, specular weighting and log on.
void sonar_muriel(benchmark::State& state) {
  integrate(state, one_sonar(), muriel::Muriel(muriel::Config{}));
}
// What its parts cost.
void sonar_muriel_without_specular(benchmark::State& state) {
  muriel::Config config;
  config.specular = false;
  integrate(state, one_sonar(), muriel::Muriel(config));
}
void sonar_muriel_without_log(benchmark::State& state) {
  muriel::Config config;
  config.log = muriel::LogPolicy::off;
  integrate(state, one_sonar(), muriel::Muriel(config));
}
// The same with the instruction set that every machine has.
void sonar_muriel_base(benchmark::State& state) {
  hwy::SetSupportedTargetsForTest(hwy::SupportedAndGeneratedTargets().back());
  integrate(state, one_sonar(), muriel::Muriel(muriel::Config{}));
  hwy::SetSupportedTargetsForTest(0);
}
void sonar_muriel_plain(benchmark::State& state) {
  integrate(state, one_sonar(), muriel::PlainMuriel(muriel::Config{}));
}
void sonar_bayes(benchmark::State& state) {
  integrate(state, one_sonar(), bayes_map::BayesMap(bayes_map::Config{}));
}
// One scan of 180 rays over half a turn, echoes at 2 m.
void laser_muriel(benchmark::State& state) {
  integrate(state, laser_scan(), muriel::Muriel(muriel::Config{}));
}
void laser_muriel_plain(benchmark::State& state) {
  integrate(state, laser_scan(), muriel::PlainMuriel(muriel::Config{}));
}

// A drive over 400 x 400 m into unseen ground; the longest single reading stands beside the mean.
void grow_to_400_m(benchmark::State& state) {
  const Observation observation = one_sonar().observation();
  double longest_us = 0.0;
  for (auto _ : state) {
    muriel::Muriel map(muriel::Config{});
    for (double along_m = -200.0; along_m <= 200.0; along_m += 0.5)
      for (const Pose2& T_map_robot : {Pose2{along_m, along_m, 0.3}, Pose2{-along_m, along_m, 2.0}}) {
        const auto begin = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(map.integrate(observation, {T_map_robot, {}}));
        const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
        longest_us = std::max(longest_us, took.count());
      }
  }
  state.counters["longest_us"] = longest_us;
}

BENCHMARK(grow_to_400_m)->Unit(benchmark::kMillisecond);
BENCHMARK(sonar_muriel_plain)->Unit(benchmark::kMicrosecond);
BENCHMARK(sonar_muriel)->Unit(benchmark::kMicrosecond);
BENCHMARK(sonar_muriel_without_specular)->Unit(benchmark::kMicrosecond);
BENCHMARK(sonar_muriel_without_log)->Unit(benchmark::kMicrosecond);
BENCHMARK(sonar_muriel_base)->Unit(benchmark::kMicrosecond);
BENCHMARK(sonar_bayes)->Unit(benchmark::kMicrosecond);
BENCHMARK(laser_muriel_plain)->Unit(benchmark::kMicrosecond);
BENCHMARK(laser_muriel)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
