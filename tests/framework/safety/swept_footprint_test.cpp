#include "framework/safety/swept_footprint.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cairn {
namespace {

RobotModel a_box() {
  RobotModel robot;
  robot.polygon_m = {{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}};
  robot.radius_m = std::hypot(0.3, 0.2);
  return robot;
}

TEST(SweptFootprint, MeasuresDistancesToDiscsAndPolygons) {
  EXPECT_NEAR(distance_to_footprint_m(RobotModel{}, {0.5, 0.0}), 0.28, 1e-12);
  EXPECT_NEAR(distance_to_footprint_m(a_box(), {0.5, 0.0}), 0.2, 1e-12);
  EXPECT_NEAR(distance_to_footprint_m(a_box(), {0.6, 0.6}), 0.5, 1e-12);
  EXPECT_NEAR(distance_to_footprint_m(a_box(), {0.25, 0.0}), -0.05, 1e-12);
  EXPECT_NEAR(reach_of_m(a_box()), std::hypot(0.3, 0.2), 1e-12);
}

TEST(SweptFootprint, ADiscDrivesUpToAPointAheadAndPastOneBeside) {
  const RobotModel robot;
  EXPECT_NEAR(free_sweep_m(robot, {0.2, 0.0}, {1.0, 0.0}, 0.05, 2.0), 1.0 - 0.27, 0.011);
  EXPECT_EQ(free_sweep_m(robot, {0.2, 0.0}, {1.0, 0.3}, 0.05, 2.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(free_sweep_m(robot, {-0.2, 0.0}, {1.0, 0.0}, 0.05, 2.0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(free_sweep_m(robot, {-0.2, 0.0}, {-1.0, 0.0}, 0.05, 2.0), 1.0 - 0.27, 0.011);
}

TEST(SweptFootprint, APolygonTurnsItsCornersIntoAPoint) {
  const RobotModel box = a_box();
  EXPECT_EQ(free_sweep_m(RobotModel{}, {0.0, 1.0}, {0.0, 0.3}, 0.05, 2.0), std::numeric_limits<double>::infinity());
  const double way_m = free_sweep_m(box, {0.0, 1.0}, {0.0, 0.32}, 0.0, 2.0);
  EXPECT_GT(way_m, 0.0);
  EXPECT_LT(way_m, 0.5);
}

TEST(SweptFootprint, WhatIsTooNearAlreadyHindersOnlyTheWayTowardsIt) {
  const RobotModel robot;
  EXPECT_EQ(free_sweep_m(robot, {0.2, 0.0}, {0.24, 0.0}, 0.05, 1.0), 0.0);
  EXPECT_EQ(free_sweep_m(robot, {-0.2, 0.0}, {0.24, 0.0}, 0.05, 1.0), std::numeric_limits<double>::infinity());
}

// Against the footprint moved in tiny steps.
TEST(SweptFootprint, AgreesWithTinyStepsOnRandomArcs) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const RobotModel robot = i % 2 == 0 ? RobotModel{} : a_box();
    const Twist twist{0.4 * any(random), any(random)};
    const Point p(1.2 * any(random), 1.2 * any(random));
    const double speed = sweep_speed_mps(robot, twist);
    if (distance_to_footprint_m(robot, p) < 0.06) continue;
    double oracle_m = std::numeric_limits<double>::infinity();
    Pose2 pose;
    for (double way = 0.0; way <= 1.0; way += 2e-4) {
      if (distance_to_footprint_m(robot, inverse(pose) * p) < 0.05) {
        oracle_m = way;
        break;
      }
      const double dt = 2e-4 / speed;
      pose = pose * Pose2{0, 0, 0.5 * twist.w_radps * dt} * Pose2{twist.v_mps * dt, 0, 0} *
             Pose2{0, 0, 0.5 * twist.w_radps * dt};
    }
    const double way_m = free_sweep_m(robot, twist, p, 0.05, 1.0);
    if (std::isfinite(oracle_m) && oracle_m < 0.98) {
      // It may graze between two steps, by less than a step; otherwise it is never given as too long.
      if (std::isfinite(way_m)) {
        EXPECT_NEAR(way_m, oracle_m, 0.03) << i;
      }
    } else if (!std::isfinite(oracle_m)) {
      EXPECT_GE(way_m, 0.9) << i;
    }
  }
}

}  // namespace
}  // namespace cairn
