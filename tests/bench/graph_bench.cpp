// The landmark graph from a hundred landmarks to a million: queries beside Boost.Graph's in the same run, building,
// memory, changes. Ratios are what counts.

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <random>
#include <string>

#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/bench/boost_searches.hpp"
#include "tests/bench/building_complex.hpp"

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFloor_m = 4.0;
constexpr std::uint64_t kSeed = 2;  // the sizes of clusters were chosen with another

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

// Random pairs of landmarks, the same ones every time.
std::vector<std::pair<LandmarkId, LandmarkId>> random_pairs(const LandmarkGraph& graph, std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<LandmarkId> any(1, static_cast<LandmarkId>(graph.landmarks().size()));
  std::vector<std::pair<LandmarkId, LandmarkId>> pairs;
  while (pairs.size() < count) {
    const std::pair<LandmarkId, LandmarkId> pair(any(random), any(random));
    if (pair.first != pair.second) pairs.push_back(pair);
  }
  return pairs;
}

// The complex of a size and its hierarchy; only the last one that was asked for is kept.
struct Site {
  explicit Site(std::size_t landmarks) : graph(building_complex(landmarks, kSeed)), hierarchy(graph) {}
  LandmarkGraph graph;
  Hierarchy hierarchy;
};

Site& site_of(std::size_t landmarks) {
  static std::size_t size = 0;
  static std::unique_ptr<Site> site;
  if (size != landmarks) {
    site.reset();
    site = std::make_unique<Site>(landmarks);
    size = landmarks;
  }
  return *site;
}

struct Timings {
  std::vector<double> us, settled;
  template <class Search>
  void time(Search search) {
    const auto begin = Clock::now();
    const std::int64_t count = search();
    us.push_back(1e6 * seconds_since(begin));
    settled.push_back(static_cast<double>(count));
  }
};

void query(benchmark::State& state) {
  const Site& site = site_of(static_cast<std::size_t>(state.range(0)));
  BoostSearches boost(site.graph, kFloor_m);
  HierarchySearch search;
  const auto pairs = random_pairs(site.graph, static_cast<std::size_t>(state.range(1)));
  Timings ours, dijkstra, astar;
  const auto find = [&](const std::pair<LandmarkId, LandmarkId>& pair) {
    const Network& network = site.hierarchy.network();
    const WayQuery query{{{network.vertex_of(pair.first)}}, {{network.vertex_of(pair.second)}}, {}, {}};
    const Way way = search.find(site.hierarchy, query, {});
    benchmark::DoNotOptimize(way.routes.data());
    return way.settled;
  };
  for (auto _ : state) {
    for (const auto& pair : pairs) ours.time([&] { return find(pair); });
    for (const auto& [from, to] : pairs) dijkstra.time([&] { return boost.dijkstra(from, to), boost.settled(); });
    for (const auto& [from, to] : pairs) astar.time([&] { return boost.astar(from, to), boost.settled(); });
    state.SetIterationTime(1e-6 * median(ours.us));
  }
  state.counters["levels"] = site.hierarchy.levels();
  state.counters["us"] = median(ours.us);
  state.counters["us_p95"] = quantile(ours.us, 0.95);
  state.counters["us_max"] = quantile(ours.us, 1.0);
  state.counters["dijkstra_us"] = median(dijkstra.us);
  state.counters["astar_us"] = median(astar.us);
  state.counters["dijkstra_ratio"] = median(dijkstra.us) / median(ours.us);
  state.counters["astar_ratio"] = median(astar.us) / median(ours.us);
  state.counters["settled"] = median(ours.settled);
  state.counters["dijkstra_settled"] = median(dijkstra.settled);
  state.counters["astar_settled"] = median(astar.settled);
}

// Landmarks, pairs.
BENCHMARK(query)
    ->Args({100, 2000})
    ->Args({1000, 2000})
    ->Args({10'000, 1000})
    ->Args({100'000, 500})
    ->Args({1'000'000, 300})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn
