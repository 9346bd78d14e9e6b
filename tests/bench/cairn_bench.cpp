// Speed of the inner loops, each beside its plain version in the same run: ratios are what counts.

#include <benchmark/benchmark.h>

#include <random>

#include "framework/contracts/module.hpp"
#include "plugins/bayes_map/bayes_map.hpp"
#include "plugins/template_matcher/match.hpp"

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

struct MatchingTask {
  template_matcher::GradientField field;
  std::vector<CellSpan> region;
  TemplateSet templates;
};

// A 25 x 25 cell region of a noisy grid with a square in it, and the 15 templates of three shapes.
MatchingTask matching_task() {
  const std::vector<LandmarkShape> shapes = {
      {"circle", Contour::circle(0.5)},
      {"square", Contour::polygon({{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})},
      {"triangle", Contour::polygon({{0.0, 0.0}, {0.6, 0.0}, {0.3, 0.52}})}};
  TemplateSet templates = render_ideal_set(shapes, radians(15.0), 0.05);
  std::mt19937_64 random(1);
  OccupancyGrid grid(0.05);
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 40; ++x) {
      const bool edge = distance8({x, y}, {0, 0}) >= 4 && distance8({x, y}, {0, 0}) <= 6;
      grid.set_log_odds({x, y}, static_cast<LogOdds>((edge ? 800 : -800) + static_cast<int>(random() % 400)));
    }
  std::vector<CellSpan> region;
  for (int y = -12; y <= 12; ++y) region.push_back({y, -12, 13});
  const int reach = template_matcher::reach_of(templates.templates);
  return {template_matcher::GradientField(grid, CellBox{{-12, -12}, {13, 13}}.grown(reach)), region, templates};
}

void match_plainly(benchmark::State& state) {
  const MatchingTask task = matching_task();
  for (auto _ : state)
    benchmark::DoNotOptimize(template_matcher::match_exhaustively(task.field, task.region, task.templates.templates));
}
BENCHMARK(match_plainly)->Unit(benchmark::kMicrosecond);

void match_with_pruning(benchmark::State& state) {
  const MatchingTask task = matching_task();
  const template_matcher::PrunedMatcher matcher(task.templates.templates);
  for (auto _ : state) benchmark::DoNotOptimize(matcher.match(task.field, task.region));
}
BENCHMARK(match_with_pruning)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
