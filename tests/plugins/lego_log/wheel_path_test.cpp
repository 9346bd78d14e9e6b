#include "plugins/lego_log/wheel_path.hpp"

#include <gtest/gtest.h>

namespace cairn::lego_log {
namespace {

constexpr Wheels kWheels{0.001, 0.2};

void expect_near(const Pose2& pose, const Pose2& expected) {
  EXPECT_NEAR(pose.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(wrap_angle(pose.theta_rad - expected.theta_rad), 0.0, 1e-9);
}

TEST(WheelPath, EqualCountsGoStraightOn) {
  WheelPath path(kWheels);
  path.add(10.0, 5000, 700);
  path.add(11.0, 5500, 1200);
  expect_near(path.at(11.0), {0.5, 0.0, 0.0});
}

TEST(WheelPath, OppositeCountsTurnOnTheSpot) {
  WheelPath path(kWheels);
  path.add(0.0, 0, 0);
  path.add(1.0, -100, 100);
  expect_near(path.at(1.0), {0.0, 0.0, 1.0});
}

TEST(WheelPath, AStandingWheelIsTheMiddleOfTheArc) {
  WheelPath path(kWheels);
  path.add(0.0, 0, 0);
  path.add(1.0, 0, 1000.0 * 0.2 * std::numbers::pi / 2.0);  // a quarter turn round the left wheel
  expect_near(path.at(1.0), {0.1, 0.1, std::numbers::pi / 2.0});
}

TEST(WheelPath, ManySmallStepsAreOneLargeOne) {
  WheelPath once(kWheels);
  WheelPath often(kWheels);
  once.add(0.0, 0, 0);
  once.add(1.0, 300, 500);
  for (int i = 0; i <= 100; ++i) often.add(0.01 * i, 3 * i, 5 * i);
  expect_near(often.at(1.0), once.at(1.0));
  expect_near(often.at(0.35), once.at(0.35));
}

TEST(WheelPath, StandsBeforeTheFirstAndAfterTheLastCounts) {
  WheelPath path(kWheels);
  path.add(1.0, 0, 0);
  path.add(1.0, 50, 50);  // counts of the same time: the later ones hold
  path.add(2.0, 100, 100);
  expect_near(path.at(0.0), {});
  expect_near(path.at(1.0), {0.05, 0.0, 0.0});
  expect_near(path.at(9.0), {0.1, 0.0, 0.0});
}

}  // namespace
}  // namespace cairn::lego_log
