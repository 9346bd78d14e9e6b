#include "plugins/odometry_compass/pose_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>

namespace cairn::odometry_compass {
namespace {

constexpr double kPi = std::numbers::pi;

MotionNoise some_noise() {
  return {0.02, 0.002, radians(1.0), 0.1, radians(3.0), 2.0};
}

double deviation(const PoseEstimate& estimate, int i) {
  return std::sqrt(estimate.covariance(i, i));
}

TEST(PoseFilter, FollowsOdometryAsPosesCompose) {
  const Pose2 start{1.0, -2.0, 2.5};
  PoseFilter filter(start, {});
  Pose2 expected = start;
  for (int i = 0; i < 200; ++i) {
    const Pose2 step{0.01, 0.0005, 0.05};
    filter.predict(step, some_noise());
    expected = expected * step;
  }
  const Pose2 got = filter.estimate().T_map_robot;
  EXPECT_NEAR(got.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(got.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(wrap_angle(got.theta_rad - expected.theta_rad), 0.0, 1e-9);
}

TEST(PoseFilter, GrowsNoLessCertainWhileItStands) {
  PoseFilter filter({}, {0.01, 0.01, 0.02, 0.05});
  const Eigen::Matrix3d before = filter.estimate().covariance;
  for (int i = 0; i < 1000; ++i) filter.predict({}, some_noise());
  EXPECT_TRUE(filter.estimate().covariance.isApprox(before, 1e-12));
}

TEST(PoseFilter, GrowsWithTheRootOfTheDistanceWhateverTheStep) {
  for (const int steps : {10, 100, 1000}) {
    PoseFilter filter({}, {});
    MotionNoise along_only;
    along_only.along_ratio = 0.03;
    for (int i = 0; i < steps; ++i) filter.predict({4.0 / steps, 0.0, 0.0}, along_only);
    EXPECT_NEAR(deviation(filter.estimate(), 0), 0.06, 1e-12) << steps;
    EXPECT_NEAR(deviation(filter.estimate(), 1), 0.0, 1e-12);
  }
}

TEST(PoseFilter, GrowsWithTheDistanceForAScaleError) {
  PoseFilter filter({0.0, 0.0, kPi / 2.0}, {0.0, 0.0, 0.02, 0.0});
  for (int i = 0; i < 100; ++i) filter.predict({0.1, 0.0, 0.0}, {});
  EXPECT_NEAR(deviation(filter.estimate(), 1), 0.2, 1e-9);
  for (int i = 0; i < 100; ++i) filter.predict({-0.1, 0.0, 0.0}, {});
  EXPECT_NEAR(filter.estimate().covariance(1, 1), 0.0, 1e-15);  // the way back undoes it
}

TEST(PoseFilter, LearnsTheHeadingFromAnUnbiasedCompass) {
  PoseFilter filter({0.0, 0.0, 0.5}, {0.0, 0.5, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(filter.correct_heading(0.8, radians(2.0), 4.0));
  EXPECT_NEAR(filter.estimate().T_map_robot.theta_rad, 0.8, 1e-3);
  EXPECT_NEAR(deviation(filter.estimate(), 2), radians(2.0) / 10.0, 1e-4);
}

TEST(PoseFilter, NeverKnowsTheHeadingBetterThanALocalBiasAllows) {
  PoseFilter filter({0.0, 0.0, 0.5}, {0.0, 1.0, 0.0, radians(3.0)});
  for (int i = 0; i < 100000; ++i) (void)filter.correct_heading(0.8, radians(2.0), 4.0);
  EXPECT_NEAR(deviation(filter.estimate(), 2), radians(3.0), radians(0.05));
}

TEST(PoseFilter, WrapsAtTheHeadingsSeam) {
  PoseFilter filter({0.0, 0.0, kPi - 0.05}, {0.0, 0.2, 0.0, 0.0});
  EXPECT_TRUE(filter.correct_heading(-kPi + 0.05, 0.01, 4.0));
  const double theta = filter.estimate().T_map_robot.theta_rad;
  EXPECT_NEAR(wrap_angle(theta - (-kPi + 0.05)), 0.0, 0.001);
  EXPECT_GT(theta, -kPi);
  EXPECT_LE(theta, kPi);
}

TEST(PoseFilter, RefusesWhatIsBeyondTheGateAndStaysAsItWas) {
  PoseFilter filter({}, {0.05, 0.02, 0.0, 0.0});
  const PoseEstimate before = filter.estimate();
  EXPECT_FALSE(filter.correct_heading(1.0, radians(2.0), 4.0));
  EXPECT_FALSE(filter.correct_position({2.0, 0.0}, {2.5, 0.0}, 0.001 * Eigen::Matrix2d::Identity(), 3.5));
  EXPECT_FALSE(filter.correct_heading(std::nan(""), radians(2.0), 4.0));
  EXPECT_EQ(filter.estimate().T_map_robot, before.T_map_robot);
  EXPECT_EQ(filter.estimate().covariance, before.covariance);
}

TEST(PoseFilter, BelievesADoubtedHeading) {
  PoseFilter filter({}, {0.0, 0.01, 0.0, 0.0});
  EXPECT_FALSE(filter.correct_heading(2.0, radians(2.0), 4.0));
  filter.doubt_heading(2.0);
  EXPECT_TRUE(filter.correct_heading(2.0, radians(2.0), 1.0));
  EXPECT_NEAR(filter.estimate().T_map_robot.theta_rad, 2.0, 0.01);
}

// Monte Carlo: of a heading and a bias whose sum is known, those draws whose bias is within the bound.
TEST(PoseFilter, BoundsABiasAsTheTruncatedDistributionDoes) {
  const double sigma_rad = radians(3.0);
  PoseFilter filter({}, {0.0, sigma_rad, 0.0, sigma_rad});
  ASSERT_TRUE(filter.correct_heading(radians(12.0), radians(0.1), 4.0));  // 6 degrees each
  const double bound_rad = radians(5.0);
  filter.bound_bias(bound_rad);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double sum_rad = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int i = 0; i < 200000; ++i) {
    const double bias_rad = radians(6.0) + sigma_rad / std::numbers::sqrt2 * normal(random);
    if (bias_rad > bound_rad) continue;
    const double heading_rad = radians(12.0) - bias_rad;
    sum_rad += heading_rad;
    squares += heading_rad * heading_rad;
    ++count;
  }
  const double mean_rad = sum_rad / count;
  const PoseEstimate estimate = filter.estimate();
  EXPECT_NEAR(estimate.T_map_robot.theta_rad, mean_rad, radians(0.1));
  EXPECT_NEAR(deviation(estimate, 2), std::sqrt(squares / count - mean_rad * mean_rad), radians(0.1));
  filter.bound_bias(bound_rad);
  EXPECT_EQ(filter.estimate().T_map_robot, estimate.T_map_robot) << "within the bound nothing is to be done";
}

TEST(PoseFilter, SlidesAlongItsHeading) {
  PoseFilter filter({1.0, 2.0, radians(90.0)}, {0.01, 0.0, 0.0, 0.0});
  filter.slide(-0.3, 0.2);
  EXPECT_NEAR(filter.estimate().T_map_robot.x_m, 1.0, 1e-12);
  EXPECT_NEAR(filter.estimate().T_map_robot.y_m, 1.7, 1e-12);
  EXPECT_NEAR(deviation(filter.estimate(), 0), 0.01, 1e-9);
  EXPECT_NEAR(deviation(filter.estimate(), 1), std::hypot(0.01, 0.2), 1e-9);
}

TEST(PoseFilter, MovesToWhereALandmarkSaysItIs) {
  PoseFilter filter({0.3, 0.0, 0.0}, {0.5, 0.001, 0.0, 0.0});
  // The landmark stands at (2, 1); a robot at the origin would see it just there.
  EXPECT_TRUE(filter.correct_position({2.0, 1.0}, {2.0, 1.0}, 1e-6 * Eigen::Matrix2d::Identity(), 3.5));
  EXPECT_NEAR(filter.estimate().T_map_robot.x_m, 0.0, 0.005);
  EXPECT_NEAR(filter.estimate().T_map_robot.y_m, 0.0, 0.005);
  EXPECT_LT(deviation(filter.estimate(), 0), 0.01);
}

TEST(PoseFilter, TurnsByALandmarksBearingAndByItsOrientation) {
  PoseFilter by_bearing({}, {1e-4, 0.2, 0.0, 0.0});
  const Pose2 truth{0.0, 0.0, 0.1};
  const Point seen = inverse(truth) * Point(3.0, 0.5);
  EXPECT_TRUE(by_bearing.correct_position({3.0, 0.5}, seen, 4e-4 * Eigen::Matrix2d::Identity(), 3.5));
  EXPECT_NEAR(by_bearing.estimate().T_map_robot.theta_rad, 0.1, 0.003);

  PoseFilter by_orientation({}, {1e-4, 0.2, 0.0, 0.0});
  const Pose2 T_map_landmark{3.0, 0.5, -kPi + 0.05};
  const Eigen::Matrix3d noise = Eigen::Vector3d(1.0, 1.0, 1e-6).asDiagonal();
  EXPECT_TRUE(by_orientation.correct_pose(T_map_landmark, inverse(truth) * T_map_landmark, noise, 3.5));
  EXPECT_NEAR(by_orientation.estimate().T_map_robot.theta_rad, 0.1, 0.001);
}

TEST(PoseFilter, KeepsItsCovarianceSymmetricAndPositive) {
  std::mt19937_64 random(61);
  std::normal_distribution<double> normal;
  PoseFilter filter({}, {0.01, 0.01, 0.02, 0.05});
  for (int i = 0; i < 5000; ++i) {
    filter.predict({0.01, 0.0, 0.02 * normal(random)}, some_noise());
    (void)filter.correct_heading(filter.estimate().T_map_robot.theta_rad + 0.03 * normal(random), radians(2.0), 4.0);
    if (i % 100 == 0) {
      const Point p = filter.estimate().T_map_robot * Point(1.0, 0.3);
      (void)filter.correct_position(p, Point(1.0, 0.3), 1e-4 * Eigen::Matrix2d::Identity(), 3.5);
    }
    const Eigen::Matrix3d c = filter.estimate().covariance;
    ASSERT_LT((c - c.transpose()).norm(), 1e-12);
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).eigenvalues().minCoeff(), 0.0);
  }
}

}  // namespace
}  // namespace cairn::odometry_compass
