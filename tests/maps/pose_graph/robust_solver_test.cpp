#include "maps/pose_graph/robust_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "maps/pose_graph/left_out_fits.hpp"
#include "tests/maps/pose_graph/random_graph.hpp"

namespace cairn {
namespace {

// A robot that drives round a block some times, with closures from lap to lap, in groups as a matcher finds them.
struct Laps {
  PoseGraph odometry;
  std::vector<PoseEdge> closures;
  std::vector<Pose2> truth;
};

constexpr std::size_t kLap = 40;

Laps laps(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  const auto measured = [&](const Pose2& exact, double noise) {
    const double x_m = noise * error(random);
    const double y_m = noise * error(random);
    return exact * Pose2{x_m, y_m, 0.3 * noise * error(random)};
  };
  const auto information = [](double noise) -> Eigen::Matrix3d {
    const Eigen::Vector3d weights(1.0, 1.0, 1.0 / 0.09);
    return Eigen::Matrix3d(weights.asDiagonal()) / (noise * noise);
  };
  constexpr double kStep = 0.04;
  constexpr double kClosure = 0.05;
  Laps made;
  Pose2 at;
  for (std::size_t i = 0; i < count * kLap; ++i) {
    made.truth.push_back(at);
    made.odometry.T_map_node.push_back(at);
    const bool is_corner = i % (kLap / 4) == kLap / 4 - 1;
    at = at * Pose2{0.5, 0.0, is_corner ? 0.5 * std::numbers::pi : 0.0};
  }
  for (std::size_t i = 0; i + 1 < made.truth.size(); ++i)
    made.odometry.edges.push_back(
        {i, i + 1, measured(inverse(made.truth[i]) * made.truth[i + 1], kStep), information(kStep)});
  for (std::size_t i = kLap; i < made.truth.size(); i += 2)
    made.closures.push_back(
        {i - kLap, i, measured(inverse(made.truth[i - kLap]) * made.truth[i], kClosure), information(kClosure)});
  return made;
}

PoseGraph with(const PoseGraph& odometry, const std::vector<PoseEdge>& closures) {
  PoseGraph whole = odometry;
  whole.edges.insert(whole.edges.end(), closures.begin(), closures.end());
  return whole;
}

std::vector<PoseEdge> false_closures(std::uint64_t seed, const Laps& made) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<PoseEdge> closures;
  while (closures.size() < made.closures.size()) {
    const std::size_t from = random() % made.truth.size();
    const std::size_t to = random() % made.truth.size();
    if (to < from + 2) continue;
    const double x_m = unit(random);
    const double y_m = unit(random);
    closures.push_back({from, to, {x_m, y_m, 0.3 * unit(random)}, made.closures.front().information});
  }
  return closures;
}

TEST(RobustSolver, WithHalfOfTheClosuresFalseTheTrueOnesFitAsWithoutThem) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Laps made = laps(seed, 4);
    const PoseGraph true_graph = with(made.odometry, made.closures);
    const double least = solve(true_graph).chi2;
    std::vector<PoseEdge> doubtful = made.closures;
    const std::vector<PoseEdge> wrong = false_closures(seed, made);
    doubtful.insert(doubtful.end(), wrong.begin(), wrong.end());
    const RobustSolution solution = solve_robustly(made.odometry, doubtful);
    EXPECT_TRUE(solution.converged) << seed;
    EXPECT_LT(chi2_of(true_graph, solution.T_map_node), 1.05 * least) << seed;
    // Believing all of them breaks the map.
    EXPECT_GT(chi2_of(true_graph, solve(with(made.odometry, doubtful)).T_map_node), 10.0 * least) << seed;
  }
}

TEST(RobustSolver, WithoutFalseOnesItIsThePlainSolution) {
  const Laps made = laps(7, 3);
  const RobustSolution solution = solve_robustly(made.odometry, made.closures);
  EXPECT_EQ(std::ranges::count(solution.is_believed, false), 0);
  EXPECT_NEAR(solution.chi2, solve(with(made.odometry, made.closures)).chi2, 1e-4);
}

TEST(RobustSolver, WithoutClosuresItIsTheOdometry) {
  const Laps made = laps(8, 1);
  const RobustSolution solution = solve_robustly(made.odometry, {});
  EXPECT_TRUE(solution.converged);
  EXPECT_NEAR(solution.chi2, 0.0, 1e-9);
}

TEST(RobustSolver, TheSameGraphGivesTheSameBytes) {
  const Laps made = laps(9, 3);
  std::vector<PoseEdge> doubtful = made.closures;
  const std::vector<PoseEdge> wrong = false_closures(9, made);
  doubtful.insert(doubtful.end(), wrong.begin(), wrong.end());
  EXPECT_EQ(solve_robustly(made.odometry, doubtful).T_map_node, solve_robustly(made.odometry, doubtful).T_map_node);
}

TEST(RobustSolver, OdometryIsTheFirstEdgeFromEachNodeToTheNext) {
  PoseGraph graph;
  graph.T_map_node.resize(3);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 1}, {1, 2}, {2, 0}})
    graph.edges.push_back({from, to, {1.0, 0.0, 0.0}, Eigen::Matrix3d::Identity()});
  const DividedGraph divided = odometry_and_closures(graph);
  EXPECT_EQ(divided.odometry.edges.size(), 2U);
  EXPECT_EQ(divided.closures.size(), 2U);
}

TEST(EdgeWitnesses, EdgesThatAgreeAreWitnessesAndOneAloneHasNone) {
  const Laps made = laps(3, 2);
  EXPECT_EQ(std::ranges::count(have_witnesses(made.closures, made.odometry, made.truth), false), 0);
  // Stated from the other end it is the same edge.
  std::vector<PoseEdge> turned = made.closures;
  for (std::size_t i = 0; i < turned.size(); i += 2) {
    std::swap(turned[i].from, turned[i].to);
    turned[i].T_from_to = inverse(turned[i].T_from_to);
  }
  EXPECT_EQ(std::ranges::count(have_witnesses(turned, made.odometry, made.truth), false), 0);
  std::vector<PoseEdge> wrong = made.closures;
  wrong[5].T_from_to = wrong[5].T_from_to * Pose2{3.0, 0.0, 1.0};
  const std::vector<bool> has = have_witnesses(wrong, made.odometry, made.truth);
  EXPECT_FALSE(has[5]);
  EXPECT_EQ(std::ranges::count(has, false), 1);
  EXPECT_FALSE(have_witnesses(std::vector{made.closures[0]}, made.odometry, made.truth)[0]);
}

// An oracle: the graph solved without the edge, and its covariance by dense inversion is that of the fit.
TEST(LeftOutFits, AnEdgeOfTheSolutionHasTheFitThatItHasWithoutIt) {
  const RandomPoseGraph made = random_pose_graph(11, 25, 12, 0.02);
  const DividedGraph divided = odometry_and_closures(made.graph);
  const std::vector<bool> all(divided.closures.size(), true);
  const std::vector<LeftOutFit> with_them =
      left_out_fits(divided.odometry, divided.closures, all, all, solve(made.graph).T_map_node);
  for (std::size_t i = 0; i < divided.closures.size(); ++i) {
    std::vector<bool> part = all;
    part[i] = false;
    std::vector<PoseEdge> others = divided.closures;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const std::vector<LeftOutFit> without =
        left_out_fits(divided.odometry, divided.closures, part, all, solve(with(divided.odometry, others)).T_map_node);
    EXPECT_NEAR(with_them[i].chi2, without[i].chi2, 0.05 * without[i].chi2 + 0.02) << i;
    EXPECT_NEAR(with_them[i].log_odds, without[i].log_odds, 0.3) << i;
  }
}

}  // namespace
}  // namespace cairn
