// Clusters by METIS beside plain alternatives of the same sizes: their quality, and what it does to queries.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>

#include "maps/clustering/cluster_quality.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/bench/graph/building_complex.hpp"
#include "tests/bench/graph/plain_clusterings.hpp"
#include "tests/bench/graph/road_network.hpp"

namespace cairn {
namespace {

constexpr double kFloor_m = 4.0;

using HierarchyOf = Hierarchy (*)(const LandmarkGraph& graph);

Hierarchy by_metis(const LandmarkGraph& graph) {
  return Hierarchy(graph);
}
Hierarchy by_growth(const LandmarkGraph& graph) {
  return {graph, {}, propose_by_growth};
}
Hierarchy by_coordinates(const LandmarkGraph& graph) {
  return Hierarchy(graph, clusters_by_coordinates(graph, {}, kFloor_m));
}

void count_queries(benchmark::State& state, const Hierarchy& hierarchy) {
  HierarchySearch search;
  std::mt19937_64 random(7);
  std::uniform_int_distribution<VertexIndex> any(0, hierarchy.network().end() - 1);
  std::vector<double> us, settled;
  for (int i = 0; i < 2000; ++i) {
    const RouteQuery query{{{any(random)}}, {{any(random)}}, {}, {}};
    const auto begin = std::chrono::steady_clock::now();
    const GraphPath path = search.find(hierarchy, query, {});
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    settled.push_back(static_cast<double>(path.settled));
  }
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  state.counters["query_us"] = median(us);
  state.counters["settled"] = median(settled);
}

void clusters(benchmark::State& state, const std::optional<LandmarkGraph>& graph, HierarchyOf hierarchy_of) {
  if (!graph.has_value()) {
    state.SkipWithError("the network is not in CAIRN_DATA");
    return;
  }
  for (auto _ : state) {
    const Hierarchy hierarchy = hierarchy_of(*graph);
    const auto levels = cluster_quality(hierarchy.network(), hierarchy.clustering());
    for (const LevelQuality& quality : levels) {
      if (quality.level != 1 && quality.level != 3) continue;
      const std::string suffix = "_" + std::to_string(quality.level);
      state.counters["clusters" + suffix] = static_cast<double>(quality.clusters);
      state.counters["cut" + suffix] = static_cast<double>(quality.routes_cut);
      state.counters["boundary" + suffix] = static_cast<double>(quality.boundary);
      state.counters["balance" + suffix] = quality.balance_ratio();
      if (quality.diameter) state.counters["diameter" + suffix] = *quality.diameter;
    }
    state.counters["ways_mb"] = static_cast<double>(hierarchy.overlay().bytes()) / 1e6;
    count_queries(state, hierarchy);
  }
}

const std::optional<LandmarkGraph>& complex_graph() {
  static const std::optional<LandmarkGraph> graph = building_complex(100'000, 2);
  return graph;
}
const std::optional<LandmarkGraph>& chicago() {
  static const std::optional<LandmarkGraph> graph = []() -> std::optional<LandmarkGraph> {
    const char* const data = std::getenv("CAIRN_DATA");
    const auto roads = std::filesystem::path(data == nullptr ? "../shared/data" : data) / "graphs" / "road_tntp";
    if (!std::filesystem::exists(roads / "ChicagoRegional_net.tntp.gz")) return std::nullopt;
    return road_network(roads, "ChicagoRegional");
  }();
  return graph;
}

void of_complex(benchmark::State& state, HierarchyOf hierarchy_of) {
  clusters(state, complex_graph(), hierarchy_of);
}
void of_chicago(benchmark::State& state, HierarchyOf hierarchy_of) {
  clusters(state, chicago(), hierarchy_of);
}
BENCHMARK_CAPTURE(of_complex, metis, by_metis)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(of_complex, growth, by_growth)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(of_complex, coordinates, by_coordinates)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(of_chicago, metis, by_metis)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(of_chicago, growth, by_growth)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(of_chicago, coordinates, by_coordinates)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cairn
