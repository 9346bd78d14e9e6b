#include "plugins/submap_graph/tied_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(TiedGraph, HeldNodesStayWhereTheyAreAndOthersBendOntoThem) {
  TiedGraph graph;
  graph.add_node({1.0, 2.0, radians(30.0)});
  graph.add_node({4.0, 1.0, radians(-50.0)});
  graph.hold();
  const Pose2 T_truth{2.0, 2.0, radians(10.0)};
  const Pose2 T_believed{2.4, 1.7, radians(12.0)};
  graph.add_node(T_believed);
  graph.tie(0, 2, inverse(graph.T_map(0)) * T_believed, Eigen::Vector3d(100.0, 100.0, 800.0).asDiagonal());
  for (std::size_t i = 3; i < 8; ++i) {
    graph.add_node(graph.T_map(i - 1) * Pose2{0.5, 0.0, 0.0});
    graph.tie(i - 1, i, {0.5, 0.0, 0.0}, kStep);
    const Pose2 T_map_node = T_truth * Pose2{0.5 * static_cast<double>(i - 2), 0.0, 0.0};
    graph.add({i % 2, i, inverse(graph.T_map(i % 2)) * T_map_node, 10.0 * kClosure, 1.0});
  }
  EXPECT_TRUE(graph.solve());
  EXPECT_EQ(graph.believed(), 5U);
  EXPECT_EQ(graph.T_map(0), (Pose2{1.0, 2.0, radians(30.0)}));
  EXPECT_EQ(graph.T_map(1), (Pose2{4.0, 1.0, radians(-50.0)}));
  EXPECT_LT((graph.T_map(7).position() - (T_truth * Pose2{2.5, 0.0, 0.0}).position()).norm(), 0.02);
  EXPECT_LT((graph.T_map(2).position() - T_truth.position()).norm(), 0.03);
}

TEST(TiedGraph, HeldNodesStayWhereTheyAreWhileTheBiasOfTheNewOnesCompassIsFound) {
  TiedGraph graph;
  graph.add_node({1.0, 2.0, radians(30.0)});
  graph.add_node({4.0, 1.0, radians(-50.0)});
  graph.hold();
  graph.expect_compass(radians(30.0), radians(3.0), 0.9);
  const Pose2 T_truth{2.0, 2.0, radians(10.0)};
  const double bias_rad = radians(20.0);
  graph.add_node({2.1, 1.9, radians(12.0)});
  graph.tie(0, 2, inverse(graph.T_map(0)) * graph.T_map(2), Eigen::Vector3d(100.0, 100.0, 800.0).asDiagonal());
  for (std::size_t i = 3; i < 12; ++i) {
    graph.add_node(graph.T_map(i - 1) * Pose2{0.5, 0.0, 0.0});
    graph.tie(i - 1, i, {0.5, 0.0, 0.0}, kStep);
    graph.add_heading({i, T_truth.theta_rad + bias_rad, 1.0 / (radians(2.0) * radians(2.0)), (i - 3) / 3});
    const Pose2 T_map_node = T_truth * Pose2{0.5 * static_cast<double>(i - 2), 0.0, 0.0};
    graph.add({i % 2, i, inverse(graph.T_map(i % 2)) * T_map_node, 10.0 * kClosure, 1.0});
  }
  EXPECT_TRUE(graph.solve());
  EXPECT_EQ(graph.believed(), 9U);
  EXPECT_EQ(graph.T_map(0), (Pose2{1.0, 2.0, radians(30.0)}));
  EXPECT_EQ(graph.T_map(1), (Pose2{4.0, 1.0, radians(-50.0)}));
  EXPECT_LT((graph.T_map(11).position() - (T_truth * Pose2{4.5, 0.0, 0.0}).position()).norm(), 0.02);
  EXPECT_NEAR(graph.T_map(11).theta_rad, T_truth.theta_rad, radians(0.5)) << "not as the compass says";
  EXPECT_NEAR(std::abs(graph.errors().compass_rad), bias_rad, radians(1.0));
}

}  // namespace
}  // namespace cairn::submap_graph
