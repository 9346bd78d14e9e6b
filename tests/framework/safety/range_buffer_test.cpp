#include "framework/safety/range_buffer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RobotModel a_robot() {
  RobotModel robot;
  robot.firing_period_s = 0.0;
  return robot;
}

// One transducer at the robot's origin that looks ahead.
Observation echo(double stamp_s, double range_m, const Pose2& T_odom_robot = {}, double bearing_rad = 0.0,
                 int sensor = 0) {
  Observation observation;
  observation.stamp_s = stamp_s;
  observation.T_odom_robot = T_odom_robot;
  observation.ranges = {{{0.0, 0.0, bearing_rad}, radians(15.0), 0.1, 5.0, range_m, sensor}};
  return observation;
}

double nearest_m(const RangeBuffer& memory) {
  double nearest = kInfinity;
  for (const SeenPoint& seen : memory.points()) nearest = std::min(nearest, seen.at.norm());
  return nearest;
}

double fastest_mps(const RangeBuffer& memory) {
  double fastest = 0.0;
  for (const SeenPoint& seen : memory.points()) fastest = std::max(fastest, seen.closing_mps);
  return fastest;
}

TEST(RangeBuffer, KeepsAnEchoOnItsWholeArcForAWhile) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, 0.8));
  ASSERT_FALSE(memory.points().empty());
  double widest_rad = 0.0;
  for (const SeenPoint& seen : memory.points()) {
    EXPECT_NEAR(seen.at.norm(), 0.8, 1e-9);
    widest_rad = std::max(widest_rad, std::abs(std::atan2(seen.at.y(), seen.at.x())));
  }
  EXPECT_NEAR(widest_rad, radians(15.0), 1e-9);
  memory.see(echo(1.9, kInfinity));
  EXPECT_FALSE(memory.points().empty()) << "silence takes nothing away";
  memory.see(echo(2.1, kInfinity));
  EXPECT_TRUE(memory.points().empty());
}

TEST(RangeBuffer, AnEchoFromBehindTakesItAway) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, 0.8));
  memory.see(echo(1.1, 2.0));
  EXPECT_NEAR(nearest_m(memory), 2.0, 1e-9);
}

TEST(RangeBuffer, WhatHasLeftTheBeamStaysWhereItWas) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, 0.5));
  memory.see(echo(1.2, 3.0, {0.0, 0.0, radians(90.0)}));  // turned away
  EXPECT_NEAR(nearest_m(memory), 0.5, 1e-9);
  for (const SeenPoint& seen : memory.points())
    EXPECT_TRUE(seen.at.norm() > 1.0 || seen.at.y() < -0.4) << "to the right now";
}

TEST(RangeBuffer, ReportsHowFastItComesNearerBeyondItsOwnMotion) {
  RangeBuffer towards_a_wall(a_robot(), 1.0);
  towards_a_wall.see(echo(1.0, 1.0));
  towards_a_wall.see(echo(1.2, 0.92, {0.08, 0.0, 0.0}));
  EXPECT_EQ(fastest_mps(towards_a_wall), 0.0);

  RangeBuffer somebody_comes(a_robot(), 1.0);
  somebody_comes.see(echo(1.0, 1.0));
  somebody_comes.see(echo(1.2, 0.88));
  EXPECT_NEAR(fastest_mps(somebody_comes), 0.6, 1e-6);

  RangeBuffer something_else(a_robot(), 1.0);
  something_else.see(echo(1.0, 4.0));
  something_else.see(echo(1.2, 1.0));
  EXPECT_EQ(fastest_mps(something_else), 0.0) << "nothing runs at 15 m/s: it has come into the beam from the side";
}

TEST(RangeBuffer, CoversWhereATransducerHasAnsweredLately) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, kInfinity));
  EXPECT_TRUE(memory.covers(0.0));
  EXPECT_TRUE(memory.covers(radians(20.0)));
  EXPECT_FALSE(memory.covers(std::numbers::pi));
  Observation silent;
  silent.stamp_s = 2.5;
  memory.see(silent);
  EXPECT_FALSE(memory.covers(0.0));
}

TEST(RangeBuffer, BadReadingsAreNone) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, std::numeric_limits<double>::quiet_NaN()));
  memory.see(echo(1.1, 0.5, {}, 0.0, -1));
  memory.see(echo(1.2, 0.5, {}, 0.0, 1 << 30));
  memory.see(echo(1.3, 0.5, {}, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(memory.points().empty());
  EXPECT_FALSE(memory.covers(0.0));
}

TEST(RangeBuffer, WhatWasFeltIsNotHeardAway) {
  RangeBuffer memory(a_robot(), 1.0);
  memory.see(echo(1.0, 3.0));
  memory.feel({0.2, 0.0});
  memory.see(echo(1.1, 3.0));
  EXPECT_NEAR(nearest_m(memory), 0.2, 1e-9);
  memory.see(echo(7.0, 3.0));
  EXPECT_NEAR(nearest_m(memory), 3.0, 1e-9);
}

}  // namespace
}  // namespace cairn
