#include "planners/landmark_search/graphs/level_graph.hpp"

#include <gtest/gtest.h>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/graph_concepts.hpp>
#include <set>

#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<LevelGraph>));
BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<LevelGraph>));
BOOST_CONCEPT_ASSERT((boost::BidirectionalGraphConcept<LevelGraph>));
BOOST_CONCEPT_ASSERT((boost::ReadablePropertyGraphConcept<LevelGraph, GraphEdge, boost::edge_weight_t>));
BOOST_CONCEPT_ASSERT((boost::ReadablePropertyGraphConcept<LevelGraph, VertexIndex, boost::vertex_index_t>));
BOOST_CONCEPT_ASSERT((boost::ReadablePropertyMapConcept<LevelIndex, VertexIndex>));
BOOST_CONCEPT_ASSERT((boost::ReadablePropertyMapConcept<EdgeCost, GraphEdge>));

constexpr ClusterSizes kSmall{4, 2, 8};

std::set<VertexIndex> vertices_of(const LevelGraph& graph) {
  const auto [first, last] = vertices(graph);
  return {first, last};
}

// The costs from a vertex by Boost's Dijkstra.
std::vector<double> costs_from(VertexIndex from, const LevelGraph& graph, const Hierarchy& hierarchy) {
  std::vector<double> costs(hierarchy.network().end(), kNoRoute);
  const boost::typed_identity_property_map<VertexIndex> itself;
  boost::dijkstra_shortest_paths(
      graph, from,
      boost::distance_map(boost::make_iterator_property_map(costs.begin(), itself)).distance_inf(kNoRoute));
  return costs;
}

TEST(LevelGraph, LevelZeroHasTheLandmarksAndTheOpenRoutes) {
  LandmarkGraph graph = drawn_graph("1<>2 2>3 3>1 1>2 4");
  graph.set_closed(3, true);
  const Hierarchy hierarchy(graph);
  const LevelGraph level(hierarchy, 0);
  EXPECT_EQ(num_vertices(level), 4U);
  std::multiset<RouteId> routes;
  for (const VertexIndex v : vertices_of(level)) {
    const auto [first, last] = out_edges(v, level);
    for (auto edge = first; edge != last; ++edge) {
      const Route& route = *graph.find_route((*edge).route);
      EXPECT_EQ(hierarchy.network().landmark_of(source(*edge, level)), route.from);
      EXPECT_EQ(hierarchy.network().landmark_of(target(*edge, level)), route.to);
      EXPECT_EQ(get(boost::edge_weight, level, *edge), route.cost_m);
      routes.insert(route.id);
    }
  }
  EXPECT_EQ(routes, (std::multiset<RouteId>{1, 2, 4, 5}));
  const VertexIndex two = hierarchy.network().vertex_of(2);
  EXPECT_EQ(out_degree(two, level), 1U);
  EXPECT_EQ(in_degree(two, level), 2U);
  EXPECT_EQ(degree(two, level), 3U);
}

TEST(LevelGraph, RemovedLandmarksAreNoVertices) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  Hierarchy hierarchy(graph);
  graph.remove(2);
  hierarchy.update(graph, {{2}, {}});
  const LevelGraph level(hierarchy, 0);
  EXPECT_EQ(get(boost::vertex_index, level, hierarchy.network().vertex_of(3)), 1U) << "indices have no gaps";
  EXPECT_EQ(vertices_of(level), (std::set{hierarchy.network().vertex_of(1), hierarchy.network().vertex_of(3)}));
}

TEST(LevelGraph, ALevelHasTheBoundaryOfItsClustersAndAllEdgesBothWays) {
  const LandmarkGraph graph = test::random_graph(200, 4);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  ASSERT_GE(hierarchy.levels(), 3);
  for (int l = 0; l <= hierarchy.levels(); ++l) {
    const LevelGraph level(hierarchy, l);
    std::set<VertexIndex> boundary;
    if (l == 0) {
      for (const auto& [id, landmark] : graph.landmarks()) boundary.insert(hierarchy.network().vertex_of(id));
    } else {
      for (const ClusterIndex c : hierarchy.clustering().of_level(l))
        boundary.insert(hierarchy.clustering().node(c).boundary.begin(), hierarchy.clustering().node(c).boundary.end());
    }
    EXPECT_EQ(vertices_of(level), boundary) << "level " << l;
    using Edge = std::tuple<VertexIndex, VertexIndex, RouteId, double>;
    std::multiset<Edge> leaving, entering;
    std::size_t out = 0, in = 0;
    for (const VertexIndex v : boundary) {
      for (auto [edge, last] = out_edges(v, level); edge != last; ++edge) {
        EXPECT_EQ((*edge).from, v);
        EXPECT_TRUE(boundary.contains((*edge).to));
        EXPECT_LT((*edge).cost, kNoRoute);
        leaving.emplace((*edge).from, (*edge).to, (*edge).route, (*edge).cost);
      }
      for (auto [edge, last] = in_edges(v, level); edge != last; ++edge)
        entering.emplace((*edge).from, (*edge).to, (*edge).route, (*edge).cost);
      out += out_degree(v, level);
      in += in_degree(v, level);
    }
    EXPECT_EQ(leaving, entering) << "level " << l;
    EXPECT_EQ(leaving.size(), out);
    EXPECT_EQ(entering.size(), in);
  }
}

TEST(LevelGraph, CostsBetweenVerticesOfALevelAreThoseOfTheLandmarkGraph) {
  const LandmarkGraph graph = test::random_graph(150, 6);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  const LevelGraph ground(hierarchy, 0);
  for (int l = 1; l <= hierarchy.levels(); ++l) {
    const LevelGraph level(hierarchy, l);
    for (const VertexIndex from : vertices_of(level)) {
      const std::vector<double> want = costs_from(from, ground, hierarchy);
      const std::vector<double> costs = costs_from(from, level, hierarchy);
      for (const VertexIndex to : vertices_of(level)) {
        if (to == from) continue;
        if (want[to] < kNoRoute)
          ASSERT_NEAR(costs[to], want[to], 1e-9) << "level " << l;
        else
          ASSERT_EQ(costs[to], kNoRoute) << "level " << l;
      }
    }
  }
}

}  // namespace
}  // namespace cairn
