#include "maps/clustering/cluster_quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/maps/drawn_graph.hpp"

namespace cairn {
namespace {

// Fours, in order.
std::vector<std::int32_t> fours(const GroupingGraph& graph, std::int32_t) {
  std::vector<std::int32_t> groups;
  for (std::int32_t i = 0; i < graph.nodes(); ++i) groups.push_back(i / 4);
  return groups;
}

std::vector<LevelQuality> quality(const LandmarkGraph& graph, std::int32_t max_for_diameter = 128) {
  const Network network(graph, cost_by_length);
  return cluster_quality(network, Clustering(network, {4, 8, 2}, fours), max_for_diameter);
}

TEST(ClusterQuality, OfALineInTwoFours) {
  const auto levels = quality(drawn_graph("1<>2 2<>3 3<>4 4>5 5<>6 6<>7 7<>8"));
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0].level, 1);
  EXPECT_EQ(levels[0].clusters, 2U);
  EXPECT_EQ(levels[0].routes_cut, 1U);
  EXPECT_EQ(levels[0].boundary, 2U);
  EXPECT_EQ(levels[0].largest, 4);
  EXPECT_DOUBLE_EQ(levels[0].mean, 4.0);
  EXPECT_DOUBLE_EQ(levels[0].balance_ratio(), 1.0);
  EXPECT_DOUBLE_EQ(levels[0].diameter.value(), 3.0);
}

TEST(ClusterQuality, TheDiameterIsOfCheapestWaysInsideAndOverPairsThatHaveOne) {
  // The route from 1 to 4 by 2 and 3 and the straight route cost the same; 8 is not got out of.
  const auto levels = quality(drawn_graph("1<>2 2<>3 3<>4 1<>3 4<>5 5<>6 6<>7 7>8 5>8"));
  EXPECT_DOUBLE_EQ(levels.at(0).diameter.value(), 3.0);
  EXPECT_EQ(levels[0].routes_cut, 2U);
}

TEST(ClusterQuality, ClosedRoutesAreCutToo) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3 3<>4 4>5 5<>6 6<>7 7<>8");
  graph.set_closed(graph.routes_from(4).back(), true);
  EXPECT_EQ(quality(graph).at(0).routes_cut, 1U);
}

TEST(ClusterQuality, NoDiameterOfLargeClustersAndNothingOfFlatGraphs) {
  EXPECT_FALSE(quality(drawn_graph("1<>2 2<>3 3<>4 4>5 5<>6 6<>7 7<>8"), 3).at(0).diameter.has_value());
  EXPECT_THAT(quality(drawn_graph("1")), testing::IsEmpty());
}

}  // namespace
}  // namespace cairn
