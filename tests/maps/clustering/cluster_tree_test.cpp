#include "maps/clustering/cluster_tree.hpp"

#include <gtest/gtest.h>

#include "maps/clustering/cluster_levels.hpp"

namespace cairn {
namespace {

// 1 <-> 2 | 3 -> 4 | 5 6, and above these two: (1 2 | 3 4) and (5 6).
struct Building {
  LandmarkGraph graph;
  ClusterTree tree;

  Building() {
    for (int i = 0; i < 6; ++i) graph.add({});
    graph.find(3)->name = "front desk";
    for (const auto& [from, to] : {std::pair{1, 2}, {2, 1}, {2, 3}, {3, 4}, {4, 5}, {5, 6}})
      graph.add_route({0, from, to, 1.0, {}, false, from == 4, 0});
    tree.clusters = {{1, {1, 1, 11, 1, ""}},
                     {2, {2, 1, 11, 3, ""}},
                     {3, {3, 1, 12, 6, "east wing"}},
                     {11, {11, 2, 0, 1, ""}},
                     {12, {12, 2, 0, 6, "annexe"}}};
    tree.cluster_of = {{1, 1}, {2, 1}, {3, 2}, {4, 2}, {5, 3}, {6, 3}};
  }
};

TEST(ClusterNames, AreTheUsersOrTheAnchors) {
  const Building b;
  EXPECT_EQ(label_of(b.tree.clusters.at(1), b.graph), "C1:L1");
  EXPECT_EQ(label_of(b.tree.clusters.at(2), b.graph), "C1:front desk");
  EXPECT_EQ(label_of(b.tree.clusters.at(3), b.graph), "east wing");
}

TEST(ClusterNames, FindTheirClusters) {
  const Building b;
  const auto found = [&](const char* name) {
    const Cluster* const cluster = find_cluster(b.tree, b.graph, name);
    return cluster == nullptr ? 0 : cluster->id;
  };
  EXPECT_EQ(found("C1:L1"), 1);
  EXPECT_EQ(found("C2:L1"), 11);
  EXPECT_EQ(found("C1:front desk"), 2);
  EXPECT_EQ(found("C1:L3"), 2);
  EXPECT_EQ(found("C1:L6"), 3) << "its own name finds it too";
  EXPECT_EQ(found("east wing"), 3);
  for (const char* none : {"", "C1:L2", "C3:L1", "C1:", "C01:L1", "front desk", "C1"})
    EXPECT_EQ(found(none), 0) << none;
}

TEST(ClusterNames, KnowWhatLooksLikeAnId) {
  for (const char* id : {"L17", "L0", "C1:L17", "C2:front desk", "C7"}) EXPECT_TRUE(looks_like_id(id)) << id;
  for (const char* name : {"", "L", "Lift", "L2a", "C", "Cafe", "C1a", "l17", "17"})
    EXPECT_FALSE(looks_like_id(name)) << name;
}

TEST(ClusterLevels, CountClustersAndTheLandmarksOnTheirBoundaries) {
  const Building b;
  const std::vector<ClusterLevel> levels = levels_of(b.tree, b.graph);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].clusters, 3U);
  EXPECT_EQ(levels[0].boundary, 4U) << "2 3 and 4 5, whose route is closed";
  EXPECT_EQ(levels[1].clusters, 2U);
  EXPECT_EQ(levels[1].boundary, 2U) << "4 5";
  EXPECT_TRUE(levels_of({}, b.graph).empty());
}

}  // namespace
}  // namespace cairn
