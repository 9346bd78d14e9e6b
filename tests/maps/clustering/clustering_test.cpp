#include "maps/clustering/clustering.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

using test::broken_law;
using test::GraphChanger;

constexpr ClusterSizes kSmall{4, 2, 8};
constexpr ClusterSizes kMiddle{16, 3, 40};

TEST(Clustering, SizesAndLevelsFollowTheRule) {
  EXPECT_EQ(kSmall.most(1), 4);
  EXPECT_EQ(kSmall.most(3), 16);
  EXPECT_EQ(kSmall.most(100), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(kSmall.levels_for(7), 0);
  EXPECT_EQ(kSmall.levels_for(8), 1);
  EXPECT_EQ(kSmall.levels_for(15), 1);
  EXPECT_EQ(kSmall.levels_for(16), 2);
  EXPECT_EQ((ClusterSizes{100, 2, 10}.levels_for(10)), 1) << "one level as soon as there are clusters at all";
}

TEST(Clustering, LawsHoldForRandomGraphs) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LandmarkGraph graph = test::random_graph(seed * 11, seed);
    const Network network(graph, cost_by_length);
    for (const ClusterSizes& sizes : {kSmall, kMiddle, ClusterSizes{}}) {
      const Clustering clustering(network, sizes);
      EXPECT_EQ(clustering.levels(), sizes.levels_for(graph.landmarks().size()));
      ASSERT_EQ(broken_law(clustering, network), "") << "seed " << seed;
    }
  }
}

TEST(Clustering, TheSameNetworkGivesTheSameClusters) {
  const LandmarkGraph graph = test::random_graph(500, 2);
  const Network network(graph, cost_by_length);
  EXPECT_EQ(Clustering(network, kSmall).tree(network), Clustering(network, kSmall).tree(network));
}

TEST(Clustering, ASmallNetworkHasNone) {
  const LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  const Network network(graph, cost_by_length);
  const Clustering clustering(network, kSmall);
  EXPECT_EQ(clustering.levels(), 0);
  EXPECT_EQ(clustering.leaf_of(0), kNoCluster);
  EXPECT_EQ(clustering.tree(network), ClusterTree{});
  const Network nothing(LandmarkGraph{}, cost_by_length);
  EXPECT_EQ(broken_law(Clustering(nothing, kSmall), nothing), "");
}

TEST(Clustering, IsNamedAfterTheLandmarkWithTheMostRoutesAndKeepsThatName) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3 2<>4 4<>5 5<>6 6<>7 6<>8 8<>9");
  Network network(graph, cost_by_length);
  Clustering clustering(network, {9, 2, 5});
  const ClusterIndex all = clustering.leaf_of(0);
  EXPECT_EQ(clustering.node(all).anchor, 2);
  const LandmarkGraph added = drawn_graph("6>1 6>3 6>9");
  for (const auto& [id, route] : added.routes()) {
    Route more = route;
    more.id = 0;
    network.sync_route(graph, graph.add_route(more), cost_by_length);
    (void)clustering.follow(network, std::vector<VertexIndex>{network.vertex_of(6), network.vertex_of(route.to)});
  }
  EXPECT_EQ(clustering.node(clustering.leaf_of(0)).anchor, 2) << "though landmark 6 has more of them by now";
}

TEST(Clustering, WhatASavedTreeSaysIsWhatIsRestored) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    for (const ClusterSizes& sizes : {kSmall, kMiddle}) {
      const LandmarkGraph graph = test::random_graph(seed * 20, seed);
      const Network network(graph, cost_by_length);
      Clustering clustering(network, sizes);
      for (ClusterIndex c = 0; c < clustering.end(); c += 3) clustering.set_name(c, "named " + std::to_string(c));
      const ClusterTree saved = clustering.tree(network);
      const Clustering restored(network, sizes, saved);
      ASSERT_EQ(broken_law(restored, network), "") << "seed " << seed;
      ASSERT_EQ(test::drawn_tree(restored.tree(network)), test::drawn_tree(saved)) << "seed " << seed;
    }
}

TEST(Clustering, WhatHasChangedSinceSavingIsMended) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    LandmarkGraph graph = test::random_graph(200, seed);
    const ClusterTree saved = [&] {
      const Network network(graph, cost_by_length);
      return Clustering(network, kMiddle).tree(network);
    }();
    (void)GraphChanger(graph, seed).batch(static_cast<int>(seed) * 10);
    const Network network(graph, cost_by_length);
    const Clustering restored(network, kMiddle, saved);
    ASSERT_EQ(broken_law(restored, network), "") << "seed " << seed;
    EXPECT_GE(restored.tree(network).next_id, saved.next_id);
  }
}

TEST(Clustering, ClustersThatTheUserHasNamedKeepTheirNamesThroughManySmallChanges) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LandmarkGraph graph = test::random_graph(400, seed);
    GraphChanger changer(graph, seed);
    Hierarchy first(graph, {}, cost_by_length, kMiddle);
    ClusterTree named = first.tree();
    for (ClusterIndex c = 0; c < first.clustering().end(); c += 2) {
      const ClusterNode& node = first.clustering().node(c);
      const bool is_lasting = 4 * node.landmarks >= kMiddle.most(node.level);  // not one or two that may all be removed
      if (is_lasting) named.clusters.at(node.id).name = "area " + std::to_string(node.id);
    }
    Hierarchy hierarchy(graph, named, cost_by_length, kMiddle);
    for (int step = 0; step < 200; ++step) hierarchy.update(graph, changer.change());
    const ClusterTree tree = hierarchy.tree();
    for (const auto& [id, cluster] : named.clusters) {
      if (cluster.name.empty()) continue;
      ASSERT_TRUE(tree.clusters.contains(id)) << cluster.name << ", seed " << seed;
      EXPECT_EQ(tree.clusters.at(id).name, cluster.name);
      EXPECT_EQ(tree.clusters.at(id).level, cluster.level);
    }
    EXPECT_NE(test::drawn_tree(tree), test::drawn_tree(named));
  }
}

// Saved trees as no program of ours writes them.
class DamagedTree : public ::testing::Test {
 protected:
  void expect_mended(const char* what) const {
    const Clustering restored(network_, kSmall, tree_);
    EXPECT_EQ(broken_law(restored, network_), "") << what;
    EXPECT_EQ(restored.levels(), kSmall.levels_for(graph_.landmarks().size())) << what;
  }
  Cluster& some(int level) {
    for (auto& [id, cluster] : tree_.clusters)
      if (cluster.level == level) return cluster;
    throw std::logic_error("no cluster of that level");
  }

  const LandmarkGraph graph_ = test::random_graph(100, 8);
  const Network network_{graph_, cost_by_length};
  ClusterTree tree_ = Clustering(network_, kSmall).tree(network_);
};

TEST_F(DamagedTree, OfUnknownLandmarksAndClusters) {
  tree_.cluster_of[100'000] = tree_.cluster_of.begin()->second;
  tree_.cluster_of.begin()->second = 77'777;
  tree_.clusters.erase(some(2).id);
  expect_mended("one is missing");
  tree_.clusters.clear();
  expect_mended("all are missing");
  tree_.cluster_of = {{100'000, 5}};
  expect_mended("nothing but an unknown landmark");
}

TEST_F(DamagedTree, OfWrongLevels) {
  some(2).level = 5;
  expect_mended("a level is left out");
  some(3).level = -2;
  expect_mended("a level below the lowest");
  for (auto& [id, cluster] : tree_.clusters) cluster.level = std::numeric_limits<int>::max();
  expect_mended("absurd levels");
}

TEST_F(DamagedTree, OfClustersThatHoldThemselves) {
  some(1).parent = some(1).id;
  expect_mended("its own parent");
  some(3).parent = some(2).id;
  expect_mended("a ring");
}

TEST_F(DamagedTree, OfTowersOfLevels) {
  ClusterId leaf = some(1).id;
  for (ClusterId id = 1000; id < 1030; ++id) {
    tree_.clusters[id] = {id, static_cast<int>(id - 998), id + 1, 0, {}};
    tree_.clusters[leaf].parent = 1000;
  }
  tree_.clusters[1029].parent = 0;
  expect_mended("one higher than all others");
}

TEST_F(DamagedTree, OfTopClustersBelowTheTop) {
  some(2).parent = 0;
  expect_mended("one without a parent");
  for (auto& [id, cluster] : tree_.clusters) cluster.parent = 0;
  expect_mended("all without");
}

TEST_F(DamagedTree, OfClustersInPiecesAndTooLarge) {
  ClusterTree thrown = tree_;
  for (auto& [landmark, cluster] : tree_.cluster_of)
    if (landmark % 3 == 0) cluster = tree_.cluster_of.begin()->second;
  expect_mended("landmarks from all over in one cluster");
  const Cluster one{1, 1, 0, 1, "all"};
  tree_ = {{{1, one}}, {}, 2};
  for (const auto& [id, landmark] : graph_.landmarks()) tree_.cluster_of[id] = 1;
  expect_mended("one cluster for all");
}

TEST_F(DamagedTree, OfIdsThatAreNotTheirOwn) {
  for (auto& [id, cluster] : tree_.clusters) cluster.id = 3;
  expect_mended("the same id for all");
  tree_ = Clustering(network_, kSmall).tree(network_);
  tree_.next_id = -5;
  expect_mended("ids to be given next that have been given");
  EXPECT_GT(Clustering(network_, kSmall, tree_).tree(network_).next_id, tree_.clusters.rbegin()->first);
  constexpr ClusterId kLast = std::numeric_limits<ClusterId>::max();
  Cluster last = some(1);
  last.id = kLast;
  for (auto& [landmark, cluster] : tree_.cluster_of)
    if (cluster == some(1).id) cluster = kLast;
  tree_.clusters[kLast] = last;
  expect_mended("an id that none can follow");
}

TEST_F(DamagedTree, OfForeignAnchors) {
  for (auto& [id, cluster] : tree_.clusters) cluster.anchor = id % 2 == 0 ? 100'000 : 1;
  expect_mended("anchors that are elsewhere or nowhere");
}

}  // namespace
}  // namespace cairn
