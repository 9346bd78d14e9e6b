// Real road networks, directed: what the hierarchy answers is what Boost.Graph's Dijkstra finds.

#include "tests/bench/graph/road_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "maps/hierarchy/hierarchies.hpp"
#include "planners/landmark_search/landmark_search.hpp"

namespace cairn {
namespace {

constexpr int kSources = 8;
constexpr int kGoals = 150;

std::filesystem::path data_folder() {
  const char* named = std::getenv("CAIRN_DATA");
  const auto folder = named != nullptr ? std::filesystem::path(named)
                                       : std::filesystem::path(CAIRN_SOURCE_DIR).parent_path() / "shared" / "data";
  return folder / "graphs" / "road_tntp";
}

using Weighted = boost::property<boost::edge_weight_t, double>;
using Plain = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Weighted>;

Plain plain_graph(const LandmarkGraph& graph) {
  Plain plain(static_cast<std::size_t>(graph.next_landmark_id()));
  for (const auto& [id, route] : graph.routes())
    boost::add_edge(static_cast<std::size_t>(route.from), static_cast<std::size_t>(route.to), route.cost_m, plain);
  return plain;
}

std::vector<double> costs_from(const Plain& plain, LandmarkId from) {
  std::vector<double> costs(boost::num_vertices(plain));
  boost::dijkstra_shortest_paths(plain, static_cast<std::size_t>(from),
                                 boost::distance_map(costs.data()).distance_inf(kNoRoute));
  return costs;
}

struct Sheet {
  const char* name;
  std::size_t landmarks;  // of the node file; three of Chicago's have no link
  std::size_t routes;
  // Or the test would be named by the bytes of an address.
  friend void PrintTo(const Sheet& sheet, std::ostream* out) { *out << sheet.name; }
};

class RoadNetwork : public ::testing::TestWithParam<Sheet> {};

TEST_P(RoadNetwork, IsAnsweredAsByDijkstra) {
  if (!std::filesystem::exists(data_folder())) GTEST_SKIP() << "no data folder: graphs/road_tntp";
  const LandmarkGraph graph = road_network(data_folder(), GetParam().name);
  ASSERT_EQ(graph.landmarks().size(), GetParam().landmarks);
  ASSERT_EQ(graph.routes().size(), GetParam().routes);
  const Plain plain = plain_graph(graph);
  const Hierarchies hierarchies(graph, {}, {});
  const OccupancyGrid grid(0.1);
  const RobotModel robot;
  const LandmarkSearch both_ends({.bidirectional_from = 0});
  const LandmarkSearch boost({.bidirectional_from = 1'000'000});
  std::mt19937_64 random(1);
  const auto any = [&] {
    const auto at = graph.landmarks().lower_bound(
        static_cast<LandmarkId>(random() % static_cast<std::uint64_t>(graph.next_landmark_id())));
    return at->first;
  };
  int reached = 0;
  for (int s = 0; s < kSources; ++s) {
    RouteRequest request;
    request.from = {{any()}};
    const std::vector<double> want = costs_from(plain, request.from.front().landmark);
    for (int g = 0; g < kGoals; ++g) {
      request.to = {{any()}};
      const double cost_m = want[static_cast<std::size_t>(request.to.front().landmark)];
      // Boost.Graph's A*, which takes longer, answers every fifth.
      const RouteResult result =
          (g % 5 == 0 ? boost : both_ends)
              .plan(request, {.grid = grid, .graph = graph, .robot = robot, .pose = {}, .hierarchies = &hierarchies},
                    {});
      const std::string where =
          "L" + std::to_string(request.from[0].landmark) + " to L" + std::to_string(request.to[0].landmark);
      ASSERT_EQ(result.outcome == PlanOutcome::solved, cost_m < kNoRoute) << where;
      if (result.outcome != PlanOutcome::solved) continue;
      ++reached;
      ASSERT_NEAR(result.cost_m, cost_m, 1e-9 * std::max(1.0, cost_m)) << where;
      LandmarkId at = request.from.front().landmark;
      for (const RouteId id : result.routes) {
        ASSERT_EQ(graph.find_route(id)->from, at) << where;
        at = graph.find_route(id)->to;
      }
      ASSERT_EQ(at, request.to.front().landmark) << where;
    }
  }
  EXPECT_GT(reached, kSources * kGoals / 2);
}

INSTANTIATE_TEST_SUITE_P(Tntp, RoadNetwork,
                         ::testing::Values(Sheet{"berlin-center", 12'981, 28'376},
                                           Sheet{"ChicagoRegional", 12'982, 39'018},
                                           Sheet{"Philadelphia", 13'389, 40'003}),
                         [](const auto& one) {
                           std::string name = one.param.name;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace cairn
