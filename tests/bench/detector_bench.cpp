// The detector over a whole mission, the drive of the paper's Table 1: everything that it does at every
// tick. One core; counters: microseconds of CPU a matching and a tick, all the detector's work included.
#include <benchmark/benchmark.h>

#include <ctime>

#include "plugins/template_matcher/template_matcher.hpp"
#include "tests/bench/recorded_drive.hpp"

namespace cairn::bench {
namespace {

using namespace template_matcher;

const RecordedDrive& table1() {
  static const RecordedDrive drive =
      record_drive(std::filesystem::path(CAIRN_SOURCE_DIR) / "config/missions/table1.yaml", 1);
  return drive;
}

double cpu_us() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

void detector_over_table1(benchmark::State& state, const Config& config) {
  const RecordedDrive& drive = table1();
  double took_us = 0.0;
  double idle_us = 0.0;  // of ticks without a matching
  std::int64_t matchings = 0;
  std::int64_t idle_ticks = 0;
  for (auto _ : state) {
    state.PauseTiming();
    OccupancyGrid grid = drive.start;
    TemplateMatcher matcher(config, drive.templates);
    for (const RecordedTick& tick : drive.ticks) {
      write(grid, tick);
      state.ResumeTiming();
      const double begin_us = cpu_us();
      const DetectionReport report = matcher.detect(grid, tick.changes, {});
      const double tick_us = cpu_us() - begin_us;
      state.PauseTiming();
      took_us += tick_us;
      matchings += static_cast<std::int64_t>(report.matchings.size());
      if (!report.matchings.empty()) continue;
      idle_us += tick_us;
      ++idle_ticks;
    }
    state.ResumeTiming();
  }
  state.counters["us_a_matching"] = took_us / static_cast<double>(matchings);
  state.counters["matching_alone_us"] = (took_us - idle_us) / static_cast<double>(matchings);
  state.counters["us_an_idle_tick"] = idle_us / static_cast<double>(idle_ticks);
  state.counters["matchings"] = static_cast<double>(matchings) / static_cast<double>(state.iterations());
}

Config with(Degrees degrees, TriggerRule trigger) {
  Config config;
  config.degrees = degrees;
  config.trigger = trigger;
  return config;
}

BENCHMARK_CAPTURE(detector_over_table1, above_threshold, with(Degrees::above_threshold, TriggerRule::since_matching))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detector_over_table1, all, with(Degrees::all, TriggerRule::since_matching))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detector_over_table1, above_threshold_ungated,
                  with(Degrees::above_threshold, TriggerRule::every_update))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn::bench
