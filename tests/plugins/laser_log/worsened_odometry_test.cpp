#include "plugins/laser_log/worsened_odometry.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cairn::laser_log {
namespace {

constexpr int kSteps = 4000;
constexpr double kStep_m = 0.1;

// Straight on; what is counted step by step.
std::vector<Pose2> counted_steps(const WornWheels& wheels) {
  WorsenedOdometry worsened(wheels);
  Pose2 before = worsened.next({1.0, 2.0, 0.5});
  std::vector<Pose2> steps;
  steps.reserve(kSteps);
  Pose2 T_odom_robot{1.0, 2.0, 0.5};
  for (int i = 0; i < kSteps; ++i) {
    T_odom_robot = T_odom_robot * Pose2{kStep_m, 0.0, 0.0};
    const Pose2 now = worsened.next(T_odom_robot);
    steps.push_back(inverse(before) * now);
    before = now;
  }
  return steps;
}

TEST(WorsenedOdometry, StepsAreLongerByTheRatioAndTurnByChance) {
  double squares = 0.0;
  double sum_rad = 0.0;
  for (const Pose2& step : counted_steps({0.03, radians(2.0), 1})) {
    EXPECT_NEAR(step.x_m, 1.03 * kStep_m, 1e-9);
    squares += step.theta_rad * step.theta_rad;
    sum_rad += step.theta_rad;
  }
  EXPECT_NEAR(std::sqrt(squares / (kSteps * kStep_m)), radians(2.0), radians(0.1));
  EXPECT_LT(std::abs(sum_rad), 4.0 * radians(2.0) * std::sqrt(kSteps * kStep_m));
}

TEST(WorsenedOdometry, SeedsDifferAndOneSeedIsTheSame) {
  const WornWheels wheels{0.0, radians(2.0), 1};
  EXPECT_EQ(counted_steps(wheels), counted_steps(wheels));
  EXPECT_NE(counted_steps(wheels), counted_steps({0.0, radians(2.0), 2}));
}

TEST(WorsenedOdometry, WithoutErrorsItIsTheLogsOwn) {
  WorsenedOdometry as_it_is({});
  const Pose2 odd{0.1 + 0.2, -1e-17, 3.0};
  (void)as_it_is.next({});
  EXPECT_EQ(as_it_is.next(odd), odd);
}

TEST(WorsenedOdometry, AStepThatIsNotFiniteIsHandedOn) {
  WorsenedOdometry worsened({0.03, radians(2.0), 1});
  (void)worsened.next({});
  EXPECT_FALSE(is_finite(worsened.next({std::nan(""), 0.0, 0.0})));
  EXPECT_TRUE(is_finite(worsened.next({0.1, 0.0, 0.0})));
}

}  // namespace
}  // namespace cairn::laser_log
