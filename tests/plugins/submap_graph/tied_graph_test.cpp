#include "plugins/submap_graph/tied_graph.hpp"

#include <gtest/gtest.h>

namespace cairn::submap_graph {
namespace {

const Eigen::Matrix3d kStep = Eigen::Vector3d(2500.0, 2500.0, 10000.0).asDiagonal();     // 2 cm, 0.6 degrees
const Eigen::Matrix3d kClosure = Eigen::Vector3d(1000.0, 1000.0, 10000.0).asDiagonal();  // 3 cm, 0.6 degrees

// A square of 40 nodes, its steps measured as turning a little too much.
TiedGraph square() {
  TiedGraph graph;
  Pose2 pose;
  graph.add_node(pose);
  for (std::size_t i = 1; i < 40; ++i) {
    const Pose2 step{1.0, 0.0, (i % 10 == 0 ? radians(90.0) : 0.0) + radians(0.3)};
    pose = pose * step;
    graph.add_node(pose);
    graph.tie(i - 1, i, step, kStep);
  }
  return graph;
}

// The last node is a metre before the first, as it would be without the error.
Closure true_closure() {
  return {0, 39, {0.0, 1.0, radians(-90.0)}, kClosure, 1.0};
}

double off_m(const TiedGraph& graph) {
  return (graph.T_map(39).position() - Point(0.0, 1.0)).norm();
}

TEST(TiedGraph, AClosureBendsThePast) {
  TiedGraph graph = square();
  EXPECT_GT(off_m(graph), 0.5);
  graph.add(true_closure());
  EXPECT_TRUE(graph.solve());
  EXPECT_LT(off_m(graph), 0.1);
  EXPECT_EQ(graph.believed(), 1U);
}

TEST(TiedGraph, AFalseClosureBesideTrueOnesIsLeftOut) {
  TiedGraph graph = square();
  for (int i = 0; i < 3; ++i) graph.add(true_closure());
  EXPECT_TRUE(graph.solve());
  graph.add({5, 25, {0.3, 0.2, 0.0}, kClosure, 1.0});
  graph.solve();
  EXPECT_LE(graph.believed(), 3U);
  EXPECT_LT(off_m(graph), 0.1);
}

TEST(TiedGraph, ASolutionThatBreaksTiesIsUndoneAsAWhole) {
  TiedGraph graph = square();
  std::vector<Pose2> before;
  for (std::size_t i = 0; i < graph.size(); ++i) before.push_back(graph.T_map(i));
  const Eigen::Matrix3d hard = 1e5 * kClosure;
  for (std::size_t i = 0; i < 6; ++i) graph.add({i, 20 + i, {0.0, 0.0, 0.0}, hard, 1.0});
  EXPECT_FALSE(graph.solve());
  EXPECT_TRUE(graph.closures().empty()) << "given up";
  for (std::size_t i = 0; i < graph.size(); ++i) EXPECT_EQ(graph.T_map(i), before[i]) << i;
}

}  // namespace
}  // namespace cairn::submap_graph
