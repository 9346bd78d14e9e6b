#include "maps/hierarchy/overlay.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

TEST(Overlay, WaysThroughClustersCostWhatDijkstraFindsInside) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LandmarkGraph graph = test::random_graph(12 * seed, seed);
    for (const ClusterSizes& sizes : {ClusterSizes{4, 2, 8}, ClusterSizes{16, 3, 40}, ClusterSizes{}})
      ASSERT_EQ(test::broken_way(Hierarchy(graph, {}, cost_by_length, sizes)), "") << "seed " << seed;
  }
}

TEST(Overlay, AWayThroughTheNeighbourDoesNotCount) {
  // 1 2 | 3 4: from 1 to 2 the direct route is dear, the detour over the other cluster cheap.
  LandmarkGraph graph = drawn_graph("1<>2 3<>4 1<>3 2<>4");
  for (const auto& [id, route] : graph.routes()) graph.set_cost(id, id <= 2 ? 10.0 : 1.0);
  const ClusterTree halves{{{1, {1, 1, 0, 1, {}}}, {2, {2, 1, 0, 3, {}}}}, {{1, 1}, {2, 1}, {3, 2}, {4, 2}}, 3};
  const Hierarchy hierarchy(graph, halves, cost_by_length, ClusterSizes{2, 2, 2, 2});
  const VertexIndex one = hierarchy.network().vertex_of(1);
  const ClusterIndex half = hierarchy.clustering().leaf_of(one);
  ASSERT_EQ(half, hierarchy.clustering().leaf_of(hierarchy.network().vertex_of(2)));
  EXPECT_EQ(hierarchy.overlay().passage(half).through, (std::vector<double>{0.0, 10.0, 10.0, 0.0}));
}

TEST(Overlay, AClosedRouteIsNoWayButStaysOnTheBoundary) {
  LandmarkGraph graph = drawn_graph("1<>2 3<>4 2<>3");
  graph.set_closed(1, true);  // 1 > 2
  graph.set_closed(5, true);  // 2 > 3
  graph.set_closed(6, true);  // 3 > 2
  const ClusterTree halves{{{1, {1, 1, 0, 1, {}}}, {2, {2, 1, 0, 3, {}}}}, {{1, 1}, {2, 1}, {3, 2}, {4, 2}}, 3};
  Hierarchy hierarchy(graph, halves, cost_by_length, ClusterSizes{2, 2, 2, 2});
  const ClusterIndex half = hierarchy.clustering().leaf_of(hierarchy.network().vertex_of(2));
  const Passage& passage = hierarchy.overlay().passage(half);
  ASSERT_EQ(passage.boundary(), 1U);
  ASSERT_EQ(passage.out.size(), 1U);
  EXPECT_EQ(passage.out[0].cost, kNoRoute);
  graph.set_closed(5, false);
  hierarchy.update(graph, {{}, {5}});
  EXPECT_EQ(hierarchy.overlay().passage(half).out[0].cost, 1.0);
  EXPECT_EQ(test::broken_way(hierarchy), "");
}

TEST(Overlay, FindsVerticesInRisingListsOnly) {
  const std::vector<std::uint32_t> rising{3, 5, 9};
  EXPECT_EQ(position_of(rising, 5), 1U);
  EXPECT_THROW((void)position_of(rising, 4), std::logic_error);
  EXPECT_THROW((void)position_of(rising, 10), std::logic_error);
}

TEST(Overlay, CountsItsBytes) {
  const LandmarkGraph graph = test::random_graph(500, 1);
  EXPECT_GT(Hierarchy(graph).overlay().bytes(), Hierarchy(test::random_graph(100, 1)).overlay().bytes());
}

}  // namespace
}  // namespace cairn
