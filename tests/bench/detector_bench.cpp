// The detector over a whole mission, the drive of the paper's Table 1: everything that it does at every
// tick. One core; counters: microseconds of CPU for each matching, all the work of the ticks included, and
// without that of the ticks that led to none; for a tick that led to none; how many times faster than exhaustive.
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

// What asking the clock twice adds to what it measures: as much as half a tick's work.
double clock_us() {
  constexpr int kTimes = 20000;
  double sum_us = 0.0;
  for (int i = 0; i < kTimes; ++i) {
    const double begin_us = cpu_us();
    sum_us += cpu_us() - begin_us;
  }
  return sum_us / kTimes;
}

struct Took {
  double all_us = 0.0;
  double idle_us = 0.0;  // of ticks without a matching
  std::int64_t matchings = 0;
  std::int64_t idle_ticks = 0;
};

void live_through(const RecordedDrive& drive, const Config& config, double clock_us, Took& took) {
  OccupancyGrid grid = drive.start;
  TemplateMatcher matcher(config, drive.templates);
  for (const RecordedTick& tick : drive.ticks) {
    write(grid, tick);
    const double begin_us = cpu_us();
    const DetectionReport report = matcher.detect(grid, tick.changes, {});
    const double tick_us = cpu_us() - begin_us - clock_us;
    took.all_us += tick_us;
    took.matchings += static_cast<std::int64_t>(report.matchings.size());
    if (!report.matchings.empty()) continue;
    took.idle_us += tick_us;
    ++took.idle_ticks;
  }
}

double& exhaustive_us() {
  static double us_a_matching = 0.0;
  return us_a_matching;
}

void detector_over_table1(benchmark::State& state, const Config& config) {
  const RecordedDrive& drive = table1();
  const double asking_us = clock_us();
  Took took;
  for (auto _ : state) {
    const double before_us = took.all_us;
    live_through(drive, config, asking_us, took);
    state.SetIterationTime(1e-6 * (took.all_us - before_us));
  }
  const double us_a_matching = took.all_us / static_cast<double>(took.matchings);
  if (config.search == Search::exhaustive) exhaustive_us() = us_a_matching;
  state.counters["us_a_matching"] = us_a_matching;
  state.counters["of_which_alone_us"] = (took.all_us - took.idle_us) / static_cast<double>(took.matchings);
  state.counters["us_an_idle_tick"] = took.idle_us / static_cast<double>(took.idle_ticks);
  state.counters["matchings"] = static_cast<double>(took.matchings) / static_cast<double>(state.iterations());
  if (exhaustive_us() > 0.0) state.counters["x_exhaustive"] = exhaustive_us() / us_a_matching;
}

Config with(Degrees degrees, TriggerRule trigger, Search search = Search::pruned) {
  Config config;
  config.degrees = degrees;
  config.trigger = trigger;
  config.search = search;
  return config;
}

// First what the others are compared with.
BENCHMARK_CAPTURE(detector_over_table1, exhaustive, with(Degrees::all, TriggerRule::since_matching, Search::exhaustive))
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(detector_over_table1, above_threshold, with(Degrees::above_threshold, TriggerRule::since_matching))
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(detector_over_table1, all_degrees, with(Degrees::all, TriggerRule::since_matching))
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(detector_over_table1, above_threshold_every_update,
                  with(Degrees::above_threshold, TriggerRule::every_update))
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace cairn::bench
