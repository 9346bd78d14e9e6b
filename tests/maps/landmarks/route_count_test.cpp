#include "maps/landmarks/route_count.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::string count_of(const std::vector<std::pair<LandmarkId, LandmarkId>>& routes) {
  LandmarkGraph graph;
  for (int i = 0; i < 4; ++i) graph.add(Landmark{});
  for (const auto& [from, to] : routes) {
    Route route;
    route.from = from;
    route.to = to;
    graph.add_route(route);
  }
  return counted_routes(graph);
}

TEST(RouteCount, SaysHowManyPairsAreJoinedBothWays) {
  EXPECT_EQ(count_of({}), "0 routes");
  EXPECT_EQ(count_of({{1, 2}}), "1 route (one way)");
  EXPECT_EQ(count_of({{1, 2}, {2, 3}}), "2 routes (all one way)");
  EXPECT_EQ(count_of({{1, 2}, {2, 1}}), "2 routes (1 pair both ways)");
  EXPECT_EQ(count_of({{1, 2}, {2, 1}, {3, 2}, {2, 3}, {3, 4}}), "5 routes (2 pairs both ways, 1 one way)");
}

}  // namespace
}  // namespace cairn
