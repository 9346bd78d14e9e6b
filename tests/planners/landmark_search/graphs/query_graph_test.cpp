#include "planners/landmark_search/graphs/query_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/graph_concepts.hpp>
#include <map>

#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"
#include "tests/planners/landmark_search/way_oracle.hpp"

namespace cairn {
namespace {

BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<QueryGraph>));

using test::Question;

// A query on a hierarchy as a graph, for as long as it is looked at.
struct Asked {
  Asked(const Hierarchy& of, const Question& question) : hierarchy(of), query(query_of(question, of.network())) {
    clusters.begin(hierarchy, query);
  }
  [[nodiscard]] QueryGraph graph() const { return {hierarchy, query, clusters}; }
  // Targets, as landmarks ("goal" is 0), with costs.
  [[nodiscard]] std::multimap<LandmarkId, double> edges_of(VertexIndex v) const {
    const QueryGraph model = graph();
    std::multimap<LandmarkId, double> edges;
    for (auto [edge, last] = out_edges(v, model); edge != last; ++edge) {
      EXPECT_EQ(source(*edge, model), v);
      const VertexIndex to = target(*edge, model);
      edges.emplace(to == model.goal() ? 0 : hierarchy.network().landmark_of(to), (*edge).cost);
    }
    EXPECT_EQ(out_degree(v, model), edges.size());
    return edges;
  }
  [[nodiscard]] std::multimap<LandmarkId, double> edges_of_landmark(LandmarkId id) const {
    return edges_of(hierarchy.network().vertex_of(id));
  }
  const Hierarchy& hierarchy;
  RouteQuery query;
  OpenClusters clusters;
};

using Edges = std::multimap<LandmarkId, double>;

TEST(QueryGraph, OneStartLeadsToAllAndAllGoalsLeadToOne) {
  const LandmarkGraph landmarks = drawn_graph("1<>2 2<>3");
  const Hierarchy hierarchy(landmarks);
  const Asked asked(hierarchy, {{{1, 5.0}, {2, 0.5}}, {{2, 3.0}, {3, 4.0}}, {}, {}});
  EXPECT_EQ(asked.edges_of(asked.graph().start()), (Edges{{1, 5.0}, {2, 0.5}}));
  EXPECT_EQ(asked.edges_of_landmark(1), (Edges{{2, 1.0}}));
  EXPECT_EQ(asked.edges_of_landmark(2), (Edges{{0, 3.0}, {1, 1.0}, {3, 1.0}}));
  EXPECT_EQ(asked.edges_of(asked.graph().goal()), Edges{});
}

TEST(QueryGraph, AvoidedLandmarksAreEnteredOnlyAsGoalsAndRoutesCostWhatTheQuerySays) {
  LandmarkGraph landmarks = drawn_graph("1>2 1>3 1>4 1>5 1>6");
  landmarks.set_closed(5, true);
  const Hierarchy hierarchy(landmarks);
  const Asked asked(hierarchy, {{{1, 0.0}}, {{3, 10.0}}, {2, 3}, {{3, kNoRoute}, {4, 0.5}, {5, 7.0}}});
  EXPECT_EQ(asked.edges_of_landmark(1), (Edges{{0, 12.0}, {5, 0.5}, {6, 7.0}}));
}

TEST(QueryGraph, LooksIntoTheClustersOfItsEndsAndPassesTheOthersOnTheHighestLevel) {
  const LandmarkGraph landmarks = test::random_graph(300, 9);
  const Hierarchy hierarchy(landmarks, {}, cost_by_length, ClusterSizes{4, 2, 8});
  ASSERT_GE(hierarchy.levels(), 3);
  const LandmarkId end = landmarks.landmarks().begin()->first;
  const Asked asked(hierarchy, {{{end, 0.0}}, {{end, 0.0}}, {}, {}});
  const QueryGraph graph = asked.graph();
  const Clustering& clustering = hierarchy.clustering();
  const VertexIndex start = hierarchy.network().vertex_of(end);
  EXPECT_EQ(graph.level_of(start), 0);
  for (const auto& [id, landmark] : landmarks.landmarks()) {
    const VertexIndex v = hierarchy.network().vertex_of(id);
    int want = 0;
    for (int level = 1; level <= hierarchy.levels(); ++level)
      if (clustering.cluster_of(v, level) != clustering.cluster_of(start, level)) want = level;
    EXPECT_EQ(graph.level_of(v), want);
    const LevelGraph level(hierarchy, want);
    if (want == 0 || !std::ranges::binary_search(level.vertices(), v)) continue;
    const auto [first, last] = out_edges(v, level);
    const auto [edge, edges_end] = out_edges(v, graph);
    EXPECT_TRUE(std::equal(edge, edges_end, first, last));
  }
}

}  // namespace
}  // namespace cairn
