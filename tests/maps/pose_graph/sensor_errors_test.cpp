#include "maps/pose_graph/sensor_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "maps/pose_graph/robust_solver.hpp"
#include "maps/pose_graph/solver.hpp"
#include "tests/maps/pose_graph/random_graph.hpp"

namespace cairn {
namespace {

constexpr double kTurnNoise_rad = radians(1.0);
constexpr double kStepNoise_m = 0.01;
constexpr double kReadingNoise_rad = radians(2.0);
constexpr std::size_t kNodesInGroup = 4;

double squared(double value) {
  return value * value;
}

struct WornRobot {
  PoseGraph graph;
  std::vector<Pose2> truth;
};

// Round a square with odometry that counts too much, a compass that is off, and closures with the first round.
WornRobot worn_robot(std::uint64_t seed, std::size_t nodes, const SensorErrors& errors) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  WornRobot made;
  made.truth.push_back({});
  made.graph.T_map_node.push_back({});
  made.graph.headings.push_back({0, 0.0, 1.0 / squared(radians(0.1))});
  const Eigen::Vector3d sigmas(kStepNoise_m, kStepNoise_m, kTurnNoise_rad);
  const Eigen::Matrix3d information = sigmas.cwiseProduct(sigmas).cwiseInverse().asDiagonal();
  const auto noisy = [&](const Pose2& exact, double part) {
    const double x_m = exact.x_m + part * kStepNoise_m * normal(random);
    const double y_m = exact.y_m + part * kStepNoise_m * normal(random);
    return Pose2{x_m, y_m, wrap_angle(exact.theta_rad + part * kTurnNoise_rad * normal(random))};
  };
  for (std::size_t i = 1; i < nodes; ++i) {
    const Pose2 step{0.5, 0.02, radians(i % 10 == 0 ? 90.0 : i % 5 == 0 ? 20.0 : i % 5 == 3 ? -20.0 : 0.0)};
    made.truth.push_back(made.truth.back() * step);
    const Pose2 counted{(1.0 + errors.length_ratio) * step.x_m, (1.0 + errors.length_ratio) * step.y_m,
                        (1.0 + errors.turn_ratio) * step.theta_rad};
    made.graph.edges.push_back({i - 1, i, noisy(counted, 1.0), information, true});
    made.graph.T_map_node.push_back(made.graph.T_map_node.back() * made.graph.edges.back().T_from_to);
    const double reading_rad = made.truth.back().theta_rad + errors.compass_rad + kReadingNoise_rad * normal(random);
    made.graph.headings.push_back(
        {i, wrap_angle(reading_rad), 1.0 / squared(kReadingNoise_rad), i / kNodesInGroup, 0.0});
    if (i >= 40 && i % 3 == 0) {
      const Pose2 seen = noisy(inverse(made.truth[i - 40]) * made.truth[i], 0.5);
      made.graph.edges.push_back({i - 40, i, seen, 4.0 * information});
    }
  }
  made.graph.expected = {0.05, 0.05, radians(30.0), radians(2.0), 0.7};
  return made;
}

// All that is unknown in one vector, and all residuals in another: nothing of the solver's own equations.
class DenseOracle {
 public:
  explicit DenseOracle(const PoseGraph& graph) : graph_(graph), nodes_(graph.T_map_node.size()) {}

  [[nodiscard]] PoseGraphSolution solution() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * nodes_ + 3 + groups_of(graph_)));
    for (std::size_t i = 0; i < nodes_; ++i)
      x.segment<3>(static_cast<Eigen::Index>(3 * i)) << graph_.T_map_node[i].x_m, graph_.T_map_node[i].y_m,
          graph_.T_map_node[i].theta_rad;
    for (int round = 0; round < 30; ++round) x += jacobian(x).colPivHouseholderQr().solve(-residuals(x));
    PoseGraphSolution solution;
    solution.chi2 = residuals(x).squaredNorm();
    solution.T_map_node = poses(x);
    solution.errors = errors(x);
    return solution;
  }

 private:
  [[nodiscard]] std::vector<Pose2> poses(const Eigen::VectorXd& x) const {
    std::vector<Pose2> poses;
    poses.reserve(nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i);
      poses.push_back({x[row], x[row + 1], wrap_angle(x[row + 2])});
    }
    return poses;
  }
  [[nodiscard]] SensorErrors errors(const Eigen::VectorXd& x) const {
    const auto first = static_cast<Eigen::Index>(3 * nodes_);
    return {x[first], x[first + 1], x[first + 2], {x.begin() + first + 3, x.end()}};
  }
  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& x) const {
    const std::vector<Pose2> T_map = poses(x);
    const SensorErrors wrong = errors(x);
    std::vector<double> all{1e3 * (T_map[0].x_m - graph_.T_map_node[0].x_m),
                            1e3 * (T_map[0].y_m - graph_.T_map_node[0].y_m)};
    for (const PoseEdge& edge : graph_.edges) {
      const Pose2 step = inverse(T_map[edge.from]) * T_map[edge.to];
      const double length = edge.is_odometry ? 1.0 + wrong.length_ratio : 1.0;
      const double turn = edge.is_odometry ? 1.0 + wrong.turn_ratio : 1.0;
      const Point off_m = rotation(-edge.T_from_to.theta_rad) * (length * step.position() - edge.T_from_to.position());
      const Eigen::Vector3d error(off_m.x(), off_m.y(), wrap_angle(turn * step.theta_rad - edge.T_from_to.theta_rad));
      const Eigen::Vector3d weighed = edge.information.llt().matrixU() * error;
      all.insert(all.end(), weighed.begin(), weighed.end());
    }
    for (const HeadingPrior& prior : graph_.headings) {
      const double bias_rad = prior.is_biased() ? wrong.compass_rad + wrong.local_compass_rad[prior.group] : 0.0;
      all.push_back(std::sqrt(prior.information) *
                    wrap_angle(T_map[prior.node].theta_rad + bias_rad - prior.heading_rad));
    }
    const ExpectedErrors& expected = graph_.expected;
    all.push_back(wrong.length_ratio / expected.length_ratio);
    all.push_back(wrong.turn_ratio / expected.turn_ratio);
    all.push_back(wrong.compass_rad / expected.compass_rad);
    const double kept = expected.local_kept_ratio;
    for (std::size_t i = 0; i < wrong.local_compass_rad.size(); ++i)
      all.push_back(i == 0 ? wrong.local_compass_rad[0] / expected.local_compass_rad
                           : (wrong.local_compass_rad[i] - kept * wrong.local_compass_rad[i - 1]) /
                                 (expected.local_compass_rad * std::sqrt(1.0 - kept * kept)));
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd jacobian(residuals(x).size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(x.size(), i);
      jacobian.col(i) = (residuals(x + step) - residuals(x - step)) / (2.0 * kStep);
    }
    return jacobian;
  }

  const PoseGraph& graph_;
  std::size_t nodes_;
};

TEST(SensorErrors, AreThoseThatADenseLeastSquaresFinds) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const WornRobot made = worn_robot(seed, 60, {0.03, -0.02, radians(15.0), {}});
    const PoseGraphSolution oracle = DenseOracle(made.graph).solution();
    const PoseGraphSolution found = solve(made.graph);
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.chi2, oracle.chi2, 1e-6 * oracle.chi2);
    EXPECT_NEAR(found.errors.length_ratio, oracle.errors.length_ratio, 1e-5);
    EXPECT_NEAR(found.errors.turn_ratio, oracle.errors.turn_ratio, 1e-5);
    EXPECT_NEAR(found.errors.compass_rad, oracle.errors.compass_rad, 1e-5);
    ASSERT_EQ(found.errors.local_compass_rad.size(), oracle.errors.local_compass_rad.size());
    for (std::size_t i = 0; i < oracle.errors.local_compass_rad.size(); ++i)
      EXPECT_NEAR(found.errors.local_compass_rad[i], oracle.errors.local_compass_rad[i], 1e-5) << i;
    for (std::size_t i = 0; i < oracle.T_map_node.size(); ++i)
      EXPECT_LT((found.T_map_node[i].position() - oracle.T_map_node[i].position()).norm(), 1e-4) << i;
  }
}

// Closures here are exact lengths, which a search in the robot's own drawings does not give.
TEST(SensorErrors, OfAWornRobotAreFoundWithinTheirDeviations) {
  double squares = 0.0;
  int values = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const SensorErrors truth{0.03, 0.02, radians(15.0), {}};
    const WornRobot made = worn_robot(seed, 200, truth);
    const PoseGraphSolution found = solve(made.graph);
    const ErrorRows rows(made.graph.expected, groups_of(made.graph), 600);
    const std::vector<double> sigmas = deviations_of(made.graph, found);
    ASSERT_EQ(sigmas.size(), static_cast<std::size_t>(rows.end - 600));
    const auto off = [&](int row, double value, double true_value) {
      const double sigma = sigmas[static_cast<std::size_t>(row - 600)];
      EXPECT_LT(std::abs(value - true_value), 4.0 * sigma) << seed << " " << row;
      squares += squared((value - true_value) / sigma);
      ++values;
    };
    off(rows.length, found.errors.length_ratio, truth.length_ratio);
    off(rows.turn, found.errors.turn_ratio, truth.turn_ratio);
    off(rows.compass, found.errors.compass_rad, truth.compass_rad);
    EXPECT_NEAR(found.errors.length_ratio, 0.03, 0.02);
    EXPECT_NEAR(found.errors.compass_rad, radians(15.0), radians(4.0));
  }
  EXPECT_LT(squares / values, 2.0) << "the deviations are honest";
}

TEST(SensorErrors, WithoutExpectationsTheyStayWhatTheyAre) {
  WornRobot made = worn_robot(4, 60, {0.05, 0.0, radians(20.0), {}});
  made.graph.expected = {};
  made.graph.errors = {0.05, 0.0, radians(20.0), {}};
  const PoseGraphSolution known = solve(made.graph);
  EXPECT_EQ(known.errors.length_ratio, 0.05);
  EXPECT_EQ(known.errors.compass_rad, radians(20.0));
  made.graph.errors = {};
  EXPECT_GT(solve(made.graph).chi2, 2.0 * known.chi2);
}

// Odometry that turns, a compass, and steel beside the way.
TEST(SensorErrors, SteelBesideTheWayTurnsNoMapThatLimitsItsReadings) {
  std::vector<double> worst_rad;
  for (const double limit : {0.0, 1.5}) {
    WornRobot made = worn_robot(5, 200, {0.0, 0.0, radians(15.0), {}});
    std::erase_if(made.graph.edges, [](const PoseEdge& edge) { return !edge.is_odometry; });
    for (HeadingPrior& prior : made.graph.headings) {
      if (!prior.is_biased()) continue;
      prior.limit_sigmas = limit;
      if (prior.node % 50 >= 20 && prior.node % 50 < 26) prior.heading_rad += radians(60.0);
    }
    const PoseGraphSolution found = solve(made.graph);
    worst_rad.push_back(0.0);
    for (std::size_t i = 0; i < made.truth.size(); ++i)
      worst_rad.back() =
          std::max(worst_rad.back(), std::abs(wrap_angle(found.T_map_node[i].theta_rad - made.truth[i].theta_rad)));
  }
  EXPECT_GT(worst_rad[0], radians(5.0));
  EXPECT_LT(worst_rad[1], radians(4.0));
}

TEST(SensorErrors, TheLossIsContinuousAndItsInformationIsItsSlope) {
  const HeadingPrior prior{0, 0.0, 100.0, HeadingPrior::kTrue, 1.5};
  for (const bool is_convex : {true, false})
    for (double theta_rad = 0.01; theta_rad < 1.0; theta_rad += 0.02) {
      constexpr double kStep = 1e-7;
      const double slope = (loss_of(prior, theta_rad + kStep, {}, is_convex).chi2 -
                            loss_of(prior, theta_rad - kStep, {}, is_convex).chi2) /
                           (2.0 * kStep);
      EXPECT_NEAR(2.0 * loss_of(prior, theta_rad, {}, is_convex).information * theta_rad, slope, 1e-3 * slope + 1e-4);
    }
  EXPECT_LT(loss_of(prior, 3.0, {}).chi2, 3.0 * 1.5 * 1.5);
}

TEST(SensorErrors, AreFoundBesideFalseClosures) {
  const WornRobot made = worn_robot(6, 120, {0.03, 0.0, radians(15.0), {}});
  DividedGraph divided = odometry_and_closures(made.graph);
  const PoseGraphSolution without = solve(made.graph);
  for (std::size_t i = 0; i < 5; ++i)
    divided.closures.push_back({7 * i, 60 + 11 * i, {1.0, -2.0, 0.4}, divided.closures[0].information});
  const RobustSolution found = solve_robustly(divided.odometry, divided.closures);
  EXPECT_NEAR(found.errors.length_ratio, without.errors.length_ratio, 1e-3);
  EXPECT_NEAR(found.errors.compass_rad, without.errors.compass_rad, radians(0.2));
}

TEST(SensorErrors, WhatIsNoExpectationIsRefused) {
  PoseGraph graph = worn_robot(1, 10, {}).graph;
  graph.expected.local_kept_ratio = 1.0;
  EXPECT_THAT([&] { (void)solve(graph); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("is no deviation")));
  graph.expected = {};
  graph.headings.back().group = graph.headings.size();
  EXPECT_THAT([&] { (void)solve(graph); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("a heading of node 9 is none")));
}

}  // namespace
}  // namespace cairn
