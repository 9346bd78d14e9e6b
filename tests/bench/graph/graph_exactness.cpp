// Answers of the hierarchical search beside Boost.Graph's Dijkstra, at volume:
//   graph_exactness [QUERIES [SEED]]
// on the road networks of CAIRN_DATA (those that are there) and a building complex of a million landmarks. Exit
// status 1 when an answer is not equal to 1e-9, relative, or its way is not one.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/bench/graph/boost_searches.hpp"
#include "tests/bench/graph/building_complex.hpp"
#include "tests/bench/graph/road_network.hpp"

namespace cairn {
namespace {

constexpr std::size_t kGoals = 400;  // of each source: one Dijkstra tree answers them all
constexpr double kEqual_ratio = 1e-9;

struct Comparison {
  std::size_t queries = 0;
  std::size_t equal = 0;
  std::size_t without_a_way = 0;  // by both
  std::size_t broken_ways = 0;    // that do not lead from end to end by open routes of that cost in all
  double worst_ratio = 0.0;
};

double difference_ratio(double a, double b) {
  if (a == b) return 0.0;
  return std::isinf(a) || std::isinf(b) ? kNoRoute : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

bool is_sound(const GraphPath& path, LandmarkId from, LandmarkId to, const LandmarkGraph& graph) {
  LandmarkId at = from;
  double cost = 0.0;
  for (const RouteId id : path.routes) {
    const Route* const route = graph.find_route(id);
    if (route == nullptr || route->closed || route->from != at) return false;
    at = route->to;
    cost += route->cost_m;
  }
  return at == to && difference_ratio(cost, path.cost) <= kEqual_ratio;
}

Comparison compare(const LandmarkGraph& graph, std::size_t queries, std::uint64_t seed) {
  const Hierarchy hierarchy(graph);
  BoostSearches boost(graph, 0.0);
  HierarchySearch search;
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : graph.landmarks()) ids.push_back(id);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> any(0, ids.size() - 1);
  Comparison comparison;
  while (comparison.queries < queries) {
    const LandmarkId from = ids[any(random)];
    const std::vector<double>& costs = boost.dijkstra_tree(from);
    for (std::size_t i = 0; i < kGoals && comparison.queries < queries; ++i, ++comparison.queries) {
      const std::size_t goal = any(random);
      const Network& network = hierarchy.network();
      const GraphPath path =
          search.find(hierarchy, {{{network.vertex_of(from)}}, {{network.vertex_of(ids[goal])}}, {}, {}}, {});
      // Boost's infinite is the greatest finite number.
      const double expected = costs[goal] < std::numeric_limits<double>::max() ? costs[goal] : kNoRoute;
      const double ratio = difference_ratio(path.cost, expected);
      comparison.worst_ratio = std::max(comparison.worst_ratio, ratio);
      if (ratio <= kEqual_ratio) ++comparison.equal;
      if (std::isinf(expected)) ++comparison.without_a_way;
      if (!std::isinf(path.cost) && !is_sound(path, from, ids[goal], graph)) ++comparison.broken_ways;
    }
  }
  return comparison;
}

bool report(const std::string& name, const LandmarkGraph& graph, std::size_t queries, std::uint64_t seed) {
  const auto begin = std::chrono::steady_clock::now();
  const Comparison found = compare(graph, queries, seed);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf(
      "%s: %zu landmarks, %zu routes: %zu of %zu equal (%zu of them: no way), worst difference %.1e, "
      "%zu ways broken; %.0f s\n",
      name.c_str(), graph.landmarks().size(), graph.routes().size(), found.equal, found.queries, found.without_a_way,
      found.worst_ratio, found.broken_ways, took.count());
  std::fflush(stdout);
  return found.equal == found.queries && found.broken_ways == 0;
}

bool compare_all(std::size_t queries, std::uint64_t seed) {
  bool all_equal = true;
  const char* const data = std::getenv("CAIRN_DATA");
  const auto roads = std::filesystem::path(data == nullptr ? "../shared/data" : data) / "graphs" / "road_tntp";
  for (const std::string name : {"berlin-center", "ChicagoRegional", "Philadelphia"})
    if (std::filesystem::exists(roads / (name + "_net.tntp.gz")))
      all_equal = report(name, road_network(roads, name), queries, seed) && all_equal;
    else
      std::printf("%s: skipped, it is not in %s (CAIRN_DATA)\n", name.c_str(), roads.c_str());
  return report("complex", building_complex(1'000'000, seed), queries, seed) && all_equal;
}

}  // namespace
}  // namespace cairn

int main(int count, char** arguments) {
  const std::size_t queries = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 100'000;
  const std::uint64_t seed = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 2;
  if (queries == 0) {
    std::fprintf(stderr, "usage: graph_exactness [QUERIES [SEED]]\n");
    return 2;
  }
  try {
    return cairn::compare_all(queries, seed) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "graph_exactness: %s\n", error.what());
    return 2;
  }
}
