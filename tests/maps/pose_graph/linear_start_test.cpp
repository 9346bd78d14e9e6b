#include "maps/pose_graph/linear_start.hpp"

#include <gtest/gtest.h>

#include "tests/maps/pose_graph/random_graph.hpp"

namespace cairn {
namespace {

TEST(LinearStart, OfExactEdgesIsTheTruth) {
  const RandomPoseGraph made = random_pose_graph(1, 60, 20, 0.0);
  const auto start = linear_start(made.graph);
  ASSERT_TRUE(start);
  for (std::size_t i = 0; i < made.truth.size(); ++i) {
    EXPECT_LT(((*start)[i].position() - made.truth[i].position()).norm(), 1e-4) << i;
    EXPECT_LT(std::abs(wrap_angle((*start)[i].theta_rad - made.truth[i].theta_rad)), 1e-5) << i;
  }
}

TEST(LinearStart, DoesNotDependOnThePosesSoFar) {
  RandomPoseGraph made = random_pose_graph(2, 40, 10, 0.05);
  const auto start = linear_start(made.graph);
  for (std::size_t i = 1; i < made.graph.T_map_node.size(); ++i) made.graph.T_map_node[i] = {};
  EXPECT_EQ(linear_start(made.graph), start);
}

TEST(LinearStart, ThereIsNoneOfAGraphInPieces) {
  PoseGraph graph;
  graph.T_map_node = {{}, {1.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  graph.edges.push_back({0, 1, {1.0, 0.0, 0.0}});
  EXPECT_FALSE(linear_start(graph));
}

}  // namespace
}  // namespace cairn
