#include "maps/cluster_tree.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_graph.hpp"

namespace cairn {
namespace {

class ClusterTreeTest : public ::testing::Test {
 protected:
  void SetUp() override { graph_.find(2)->name = "kitchen"; }
  ClusterId found(const std::string& label) const {
    const Cluster* const cluster = find_cluster(tree_, graph_, label);
    return cluster == nullptr ? 0 : cluster->id;
  }

  LandmarkGraph graph_ = drawn_graph("1<>2 2<>3");
  ClusterTree tree_{{{4, {4, 1, 9, 1, {}}},
                     {5, {5, 1, 9, 2, {}}},
                     {6, {6, 1, 9, 3, "hall"}},
                     {7, {7, 1, 9, 77, "hall"}},
                     {8, {8, 1, 9, 78, "C1:L1"}},
                     {9, {9, 2, 0, 1, {}}}},
                    {{1, 4}, {2, 5}, {3, 6}},
                    10};
};

TEST_F(ClusterTreeTest, AClusterIsCalledWhatTheUserNamedItElseAfterItsAnchor) {
  EXPECT_EQ(label_of(tree_.clusters.at(4), graph_), "C1:L1");
  EXPECT_EQ(label_of(tree_.clusters.at(5), graph_), "C1:kitchen");
  EXPECT_EQ(label_of(tree_.clusters.at(6), graph_), "hall");
  EXPECT_EQ(label_of(tree_.clusters.at(9), graph_), "C2:L1");
  tree_.clusters.at(7).name.clear();
  EXPECT_EQ(label_of(tree_.clusters.at(7), graph_), "C1:L77") << "an anchor that is gone";
}

TEST_F(ClusterTreeTest, IsFoundByEither) {
  EXPECT_EQ(found("C1:kitchen"), 5);
  EXPECT_EQ(found("C2:L1"), 9);
  EXPECT_EQ(found("hall"), 6) << "the lower of namesakes";
  EXPECT_EQ(found("C1:L3"), 6) << "one with a name too";
  EXPECT_EQ(found("C1:L1"), 8) << "a given name wins";
}

TEST_F(ClusterTreeTest, NothingIsFoundByWhatNamesNone) {
  EXPECT_EQ(found(""), 0);
  EXPECT_EQ(found("C3:L1"), 0);
  EXPECT_EQ(found("kitchen"), 0);
  EXPECT_EQ(find_cluster({}, graph_, "hall"), nullptr);
}

}  // namespace
}  // namespace cairn
