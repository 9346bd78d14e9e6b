#include "planners/landmark_search/refinement.hpp"

#include <gtest/gtest.h>

#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

TEST(Refinement, APassageBecomesRoutesInsideTheClusterThatCostWhatIsKept) {
  const LandmarkGraph graph = test::random_graph(150, 11);
  const Hierarchy hierarchy(graph, {}, cost_by_length, ClusterSizes{4, 2, 8});
  ASSERT_GE(hierarchy.levels(), 3);
  const Network& network = hierarchy.network();
  int refined = 0;
  for (int level = 1; level <= hierarchy.levels(); ++level)
    for (const ClusterIndex cluster : hierarchy.clustering().of_level(level)) {
      const std::vector<VertexIndex>& boundary = hierarchy.clustering().node(cluster).boundary;
      const Passage& passage = hierarchy.overlay().passage(cluster);
      for (std::size_t from = 0; from < boundary.size(); ++from)
        for (std::size_t to = 0; to < boundary.size(); ++to) {
          const double kept = passage.through[from * boundary.size() + to];
          if (from == to || !(kept < kNoRoute)) continue;
          GraphPath path;
          path.vertices = {boundary[from]};
          append_passage(hierarchy, cluster, from, to, path);
          double cost = 0.0;
          ASSERT_EQ(path.routes.size() + 1, path.vertices.size());
          for (std::size_t i = 0; i < path.routes.size(); ++i) {
            const Route& route = *graph.find_route(path.routes[i]);
            ASSERT_EQ(network.vertex_of(route.from), path.vertices[i]);
            ASSERT_EQ(network.vertex_of(route.to), path.vertices[i + 1]);
            ASSERT_EQ(hierarchy.clustering().cluster_of(path.vertices[i + 1], level), cluster);
            ASSERT_FALSE(route.closed);
            cost += route.cost_m;
          }
          ASSERT_EQ(path.vertices.back(), boundary[to]);
          ASSERT_NEAR(cost, kept, 1e-9);
          ++refined;
        }
    }
  EXPECT_GT(refined, 100);
}

TEST(Refinement, WhatLiesBetweenTwoVisitsOfALandmarkIsLeftOut) {
  GraphPath path;
  path.vertices = {1, 2, 3, 2, 4, 5, 4, 6};
  path.routes = {12, 23, 32, 24, 45, 54, 46};
  remove_loops(path);
  EXPECT_EQ(path.vertices, (std::vector<VertexIndex>{1, 2, 4, 6}));
  EXPECT_EQ(path.routes, (std::vector<RouteId>{12, 24, 46}));
}

}  // namespace
}  // namespace cairn
