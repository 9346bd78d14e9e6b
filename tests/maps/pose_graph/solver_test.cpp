#include "maps/pose_graph/solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/maps/pose_graph/random_graph.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PoseGraphSolver, ExactEdgesGiveTheTruthFromAnyStart) {
  RandomPoseGraph made = random_pose_graph(1, 80, 30, 0.0);
  for (std::size_t i = 1; i < made.graph.T_map_node.size(); ++i) made.graph.T_map_node[i] = {};
  const PoseGraphSolution solution = solve(made.graph);
  EXPECT_TRUE(solution.converged);
  EXPECT_LT(solution.chi2, 1e-6);
  for (std::size_t i = 0; i < made.truth.size(); ++i)
    EXPECT_LT((solution.T_map_node[i].position() - made.truth[i].position()).norm(), 1e-4) << i;
}

TEST(PoseGraphSolver, NoSmallChangeOfAnyPoseLowersChi2) {
  const RandomPoseGraph made = random_pose_graph(2, 30, 15, 0.05);
  const PoseGraphSolution solution = solve(made.graph);
  EXPECT_NEAR(solution.chi2, chi2_of(made.graph, solution.T_map_node), 1e-9 * solution.chi2);
  for (std::size_t i = 0; i < made.truth.size(); ++i)
    for (int k = 0; k < 6; ++k) {
      std::vector<Pose2> changed = solution.T_map_node;
      const double step = k % 2 == 0 ? 1e-4 : -1e-4;
      (k < 2 ? changed[i].x_m : k < 4 ? changed[i].y_m : changed[i].theta_rad) += step;
      EXPECT_GT(chi2_of(made.graph, changed), solution.chi2 - 1e-9) << i << " " << k;
    }
}

TEST(PoseGraphSolver, Chi2IsWhatTheNoiseOfTheEdgesMakesIt) {
  double ratio = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomPoseGraph made = random_pose_graph(seed, 60, 60, 0.02);
    // Three values an edge, three unknowns a node but the first.
    ratio += solve(made.graph).chi2 / (3.0 * (59.0 + 60.0) - 3.0 * 59.0) / 10.0;
  }
  EXPECT_NEAR(ratio, 1.0, 0.15);
}

TEST(PoseGraphSolver, HeadingsTurnTheWholeGraph) {
  RandomPoseGraph made = random_pose_graph(4, 20, 5, 0.0);
  for (std::size_t i = 0; i < 20; i += 4)
    made.graph.headings.push_back({i, wrap_angle(made.truth[i].theta_rad + 0.3), 100.0});
  const PoseGraphSolution solution = solve(made.graph);
  EXPECT_NEAR(wrap_angle(solution.T_map_node[7].theta_rad - made.truth[7].theta_rad), 0.3, 1e-6);
  EXPECT_LT((solution.T_map_node[0].position() - made.truth[0].position()).norm(), 1e-9);
}

TEST(PoseGraphSolver, TheSameGraphGivesTheSameBytes) {
  const RandomPoseGraph made = random_pose_graph(5, 50, 20, 0.05);
  EXPECT_EQ(solve(made.graph).T_map_node, solve(made.graph).T_map_node);
}

TEST(PoseGraphSolver, AGraphInPiecesKeepsThePlacesOfThePiecesApart) {
  RandomPoseGraph made = random_pose_graph(6, 20, 5, 0.01);
  std::erase_if(made.graph.edges, [](const PoseEdge& edge) { return (edge.from < 10) != (edge.to < 10); });
  const PoseGraphSolution solution = solve(made.graph);
  EXPECT_TRUE(solution.converged);
  for (const Pose2& pose : solution.T_map_node) EXPECT_TRUE(is_finite(pose));
}

TEST(PoseGraphSolver, ACancelledSearchReturnsTheBestSoFar) {
  const RandomPoseGraph made = random_pose_graph(7, 30, 10, 0.1);
  int asked = 0;
  const PoseGraphSolution solution = solve(made.graph, {}, [&] { return ++asked > 1; });
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(solution.iterations, 1);
  EXPECT_LE(solution.chi2, chi2_of(made.graph, made.graph.T_map_node));
}

TEST(PoseGraphSolver, RefusesWhatIsNoGraph) {
  PoseGraph graph;
  EXPECT_THAT([&] { (void)solve(graph); }, ThrowsMessage<std::invalid_argument>(HasSubstr("it has no node")));
  graph.T_map_node = {{}, {}};
  graph.edges = {{0, 2, {}}};
  EXPECT_THAT([&] { (void)solve(graph); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("edge 0 does not join two nodes")));
  graph.edges = {{0, 1, {}}};
  graph.edges[0].information(1, 1) = -1.0;
  EXPECT_THAT([&] { (void)solve(graph); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("edge 0 has a negative information")));
  graph.edges[0] = {0, 1, {NAN, 0.0, 0.0}};
  EXPECT_THAT([&] { (void)solve(graph); }, ThrowsMessage<std::invalid_argument>(HasSubstr("edge 0 is not finite")));
}

}  // namespace
}  // namespace cairn
