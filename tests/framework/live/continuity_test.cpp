#include "framework/live/continuity.hpp"

#include <gtest/gtest.h>

namespace cairn::live {
namespace {

Observation observation(double stamp_s, double x_m, double range_m = 0.0) {
  Observation seen;
  seen.stamp_s = stamp_s;
  seen.T_odom_robot.x_m = x_m;
  if (range_m > 0.0) seen.ranges.push_back({{0.1, 0.0, 0.0}, 0.26, 0.1, 5.0, range_m, 3});
  return seen;
}

TEST(Assembled, WhatHasComeSinceTheLastTickIsOneObservationSeenFromWhereTheRobotIsNow) {
  const Observation one =
      assembled({observation(1.0, 0.0, 2.0), observation(1.04, 0.01, 3.0), observation(1.08, 0.03)});
  EXPECT_EQ(one.stamp_s, 1.08);
  EXPECT_EQ(one.T_odom_robot.x_m, 0.03);
  ASSERT_EQ(one.ranges.size(), 2U);
  EXPECT_NEAR(one.ranges[0].T_robot_sensor.x_m, 0.07, 1e-12);
  EXPECT_EQ(one.ranges[0].range_m, 2.0);
  EXPECT_NEAR(one.ranges[1].T_robot_sensor.x_m, 0.08, 1e-12);
}

TEST(Assembled, PicturesOfAllAreKept) {
  std::vector<Observation> seen{observation(1.0, 0.0), observation(1.04, 0.01), observation(1.08, 0.03)};
  seen[0].images.resize(1);
  seen[0].images[0].stamp_s = 0.9;
  seen[2].images.resize(1);
  seen[2].images[0].stamp_s = 1.05;
  const Observation one = assembled(seen);
  ASSERT_EQ(one.images.size(), 2U);
  EXPECT_EQ(one.images[0].stamp_s, 0.9);
  EXPECT_EQ(one.images[1].stamp_s, 1.05);
}

TEST(Assembled, OneAloneIsItself) {
  const Observation one = assembled({observation(1.0, 0.5, 2.0)});
  EXPECT_EQ(one.stamp_s, 1.0);
  EXPECT_EQ(one.ranges[0].T_robot_sensor, (Pose2{0.1, 0.0, 0.0}));
}

TEST(Assembled, OldReadingsAreLeftOutAndABumpIsNot) {
  Observation old = observation(1.0, 0.0, 2.0);
  old.bumped = true;
  const Observation one = assembled({old, observation(9.0, 0.0, 3.0)});
  EXPECT_EQ(one.ranges.size(), 1U);
  EXPECT_TRUE(one.bumped);
}

class ARun : public testing::Test {
 protected:
  Continuity run_{RobotModel{}};
};

TEST_F(ARun, OdometryBeginsWhereTheMissionDoes) {
  EXPECT_EQ(run_.continued(observation(100.0, 7.0), 5.0).T_odom_robot, Pose2{});
  EXPECT_DOUBLE_EQ(run_.continued(observation(100.1, 7.02), 5.1).T_odom_robot.x_m, 7.02 - 7.0);
}

TEST_F(ARun, StampsGoOnByTheTimeThatHasPassedWhenTheBasesClockIsSet) {
  (void)run_.continued(observation(100.0, 0.0), 5.0);
  const double back_s = run_.continued(observation(40.0, 0.01), 5.1).stamp_s;
  EXPECT_NEAR(back_s, 100.1, 1e-9) << "an hour back, or a minute";
  EXPECT_NEAR(run_.continued(observation(40.1, 0.02), 5.2).stamp_s, 100.2, 1e-9);
  const Observation ahead = run_.continued(observation(3640.2, 0.03), 5.3);
  EXPECT_NEAR(ahead.stamp_s, 100.3, 1e-9);
  EXPECT_DOUBLE_EQ(ahead.T_odom_robot.x_m, 0.03) << "the odometry goes on";
  EXPECT_EQ(run_.clock_steps(), 2);
}

TEST_F(ARun, ABacklogIsNoStepOfTheClock) {
  (void)run_.continued(observation(100.0, 0.0), 5.0);
  EXPECT_EQ(run_.continued(observation(100.1, 0.0), 15.0).stamp_s, 100.1);
  EXPECT_EQ(run_.continued(observation(110.0, 0.0), 15.0).stamp_s, 110.0) << "no step";
  EXPECT_EQ(run_.clock_steps(), 0);
}

TEST_F(ARun, ABaseThatHasStartedAgainStandsWhereItWasLastSeen) {
  (void)run_.continued(observation(100.0, 0.0), 5.0);
  (void)run_.continued(observation(102.0, 0.6), 7.0);
  run_.interrupt();
  const Observation again = run_.continued(observation(0.04, 0.0), 9.0);
  EXPECT_NEAR(again.stamp_s, 104.0, 1e-9);
  EXPECT_NEAR(again.T_odom_robot.x_m, 0.6, 1e-12);
  EXPECT_NEAR(run_.continued(observation(0.08, 0.01), 9.04).T_odom_robot.x_m, 0.61, 1e-12);
}

TEST_F(ARun, ABaseThatWentOnMeanwhileIsWhereItSays) {
  (void)run_.continued(observation(100.0, 0.0), 5.0);
  run_.interrupt();
  const Observation again = run_.continued(observation(102.0, 0.15), 7.0);
  EXPECT_EQ(again.stamp_s, 102.0);
  EXPECT_DOUBLE_EQ(again.T_odom_robot.x_m, 0.15);
}

}  // namespace
}  // namespace cairn::live
