// From how many landmarks on the search from both ends is faster than Boost.Graph's A* over the same levels. Each query
// is asked of every search, one after the other. Ratios are what counts.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <vector>

#include "planners/landmark_search/boost_search.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/bench/graph/boost_searches.hpp"
#include "tests/bench/graph/building_complex.hpp"

namespace cairn {
namespace {

constexpr std::uint64_t kComplexSeed = 2;
constexpr double kFloorHeight_m = 4.0;

// The first landmarks of a complex; one of a floor or more is whole.
LandmarkGraph part_of_complex(std::size_t landmarks) {
  LandmarkGraph graph = building_complex(landmarks, kComplexSeed);
  while (graph.landmarks().size() > landmarks) graph.remove(graph.landmarks().rbegin()->first);
  return graph;
}

struct QueryTimes {
  std::vector<double> us;
  template <class Search>
  void time(Search search) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(search());
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  [[nodiscard]] double median_us() {
    std::ranges::nth_element(us, us.begin() + static_cast<std::ptrdiff_t>(us.size() / 2));
    return us[us.size() / 2];
  }
};

void searches(benchmark::State& state) {
  const LandmarkGraph graph = part_of_complex(static_cast<std::size_t>(state.range(0)));
  const Hierarchy hierarchy(graph);
  const Hierarchy flat(graph, {}, cost_by_length, no_clusters());
  BoostSearches boost(graph, kFloorHeight_m);
  BoostSearch on_levels, on_landmarks;
  HierarchySearch both_ends, both_ends_flat;
  QueryTimes levels, landmarks, ours, ours_flat, dijkstra;
  std::mt19937_64 random(7);
  std::uniform_int_distribution<LandmarkId> any(1, static_cast<LandmarkId>(graph.landmarks().size()));
  const auto find = [](GraphSearch& search, const Hierarchy& of, LandmarkId from, LandmarkId to) {
    return search.find(of, {{{of.network().vertex_of(from)}}, {{of.network().vertex_of(to)}}, {}, {}}, {}).cost;
  };
  for (auto _ : state) {
    for (std::int64_t i = 0; i < state.range(1); ++i) {
      const LandmarkId from = any(random);
      const LandmarkId to = any(random);
      levels.time([&] { return find(on_levels, hierarchy, from, to); });
      ours.time([&] { return find(both_ends, hierarchy, from, to); });
      landmarks.time([&] { return find(on_landmarks, flat, from, to); });
      ours_flat.time([&] { return find(both_ends_flat, flat, from, to); });
      dijkstra.time([&] { return boost.dijkstra(from, to); });
    }
    state.SetIterationTime(1e-6 * levels.median_us());
  }
  state.counters["levels"] = hierarchy.levels();
  state.counters["astar_us"] = levels.median_us();
  state.counters["both_ends_us"] = ours.median_us();
  state.counters["flat_astar_us"] = landmarks.median_us();
  state.counters["flat_both_ends_us"] = ours_flat.median_us();
  state.counters["flat_dijkstra_us"] = dijkstra.median_us();
  state.counters["astar_to_both_ends"] = levels.median_us() / ours.median_us();
}
// Landmarks and queries.
void sizes(benchmark::internal::Benchmark* bench) {
  for (const std::int64_t landmarks : {8, 16, 32, 64, 128, 256, 512, 1'000, 2'000, 5'000, 10'000, 20'000})
    bench->Args({landmarks, 1'000});
  for (const std::int64_t landmarks : {50'000, 100'000}) bench->Args({landmarks, 100});
}
BENCHMARK(searches)->Apply(sizes)->Iterations(1)->UseManualTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
