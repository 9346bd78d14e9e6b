// What a tick costs beside the work of the modules: missions of modules that do nothing.

#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>

#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

void tick_of_the_host(benchmark::State& state) {
  constexpr int kTicks = 100000;
  const ModuleLibrary library = still::library();
  const auto out = std::filesystem::temp_directory_path() / "cairn_host_bench";
  std::filesystem::create_directories(out);
  const auto begin = std::chrono::steady_clock::now();
  for (auto _ : state) MissionRunner(still::mission(kTicks), library, {out, false, nullptr}).run();
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  state.counters["us_a_tick"] = took.count() / (static_cast<double>(state.iterations()) * kTicks);
}
BENCHMARK(tick_of_the_host)->Unit(benchmark::kMillisecond)->UseRealTime();

void load_all_modules(benchmark::State& state) {
  const auto folders = plugin_folders({CAIRN_BINARY_DIR "/lib/cairn"});
  for (auto _ : state) benchmark::DoNotOptimize(ModuleLibrary({folders.front()}).entries().size());
}
BENCHMARK(load_all_modules)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cairn
