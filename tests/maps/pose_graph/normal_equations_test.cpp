#include "maps/pose_graph/normal_equations.hpp"

#include <gtest/gtest.h>

#include "tests/maps/pose_graph/random_graph.hpp"

namespace cairn {
namespace {

// Half of chi2's derivative by each coordinate, by differences.
Eigen::VectorXd gradient_by_differences(const PoseGraph& graph) {
  constexpr double kStep = 1e-6;
  Eigen::VectorXd gradient(static_cast<Eigen::Index>(3 * graph.T_map_node.size()));
  for (std::size_t i = 0; i < graph.T_map_node.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto chi2_at = [&](double step) {
        std::vector<Pose2> poses = graph.T_map_node;
        (k == 0 ? poses[i].x_m : k == 1 ? poses[i].y_m : poses[i].theta_rad) += step;
        return chi2_of(graph, poses);
      };
      gradient[static_cast<Eigen::Index>(3 * i) + k] = (chi2_at(kStep) - chi2_at(-kStep)) / (4.0 * kStep);
    }
  return gradient;
}

TEST(NormalEquations, TheGradientIsHalfOfChi2sDerivative) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PoseGraph graph = random_pose_graph(seed, 8, 4, 0.1).graph;
    graph.edges[2].information(0, 2) = graph.edges[2].information(2, 0) = 20.0;
    if (seed % 2 == 0) graph.headings = {{3, 0.4, 7.0}, {5, -2.0, 2.0}};
    NormalEquations equations(graph);
    equations.fill(graph.T_map_node, graph.errors);
    const Eigen::VectorXd expected = gradient_by_differences(graph);
    EXPECT_LT((equations.gradient() - expected).cwiseAbs().maxCoeff(), 1e-4 * expected.cwiseAbs().maxCoeff()) << seed;
  }
}

TEST(NormalEquations, OfExactEdgesTheHessianIsHalfOfChi2sSecondDerivative) {
  const RandomPoseGraph made = random_pose_graph(3, 6, 3, 0.0);
  NormalEquations equations(made.graph);
  equations.fill(made.truth, {});
  PoseGraph moved = made.graph;
  const Eigen::Index rows = equations.gradient().size();
  Eigen::VectorXd step = Eigen::VectorXd::Random(rows) * 1e-4;
  step.head<3>().setZero();  // the tie of node 0 is not in chi2
  moved.T_map_node = made.truth;
  for (std::size_t i = 0; i < made.truth.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    moved.T_map_node[i] = {made.truth[i].x_m + step[row], made.truth[i].y_m + step[row + 1],
                           made.truth[i].theta_rad + step[row + 2]};
  }
  const Eigen::MatrixXd lower = equations.hessian();
  const Eigen::MatrixXd hessian = lower.selfadjointView<Eigen::Lower>();
  const double predicted = step.dot(hessian * step);
  EXPECT_NEAR(chi2_of(moved, moved.T_map_node), predicted, 1e-2 * predicted);
}

}  // namespace
}  // namespace cairn
