#include "plugins/p2os_robot/counted_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn::p2os_robot {
namespace {

Information at(int x, int y, int heading) {
  Information seen;
  seen.x_counts = x & 0x7FFF;
  seen.y_counts = y & 0x7FFF;
  seen.heading_counts = heading;
  return seen;
}

class Odometry : public testing::Test {
 protected:
  Odometry() { odometry.begin_session(*units_of("p3dx-sh")); }
  CountedOdometry odometry{Units{}, 0.5};
};

TEST_F(Odometry, BeginsAtTheOriginWhateverTheRobotHasCounted) {
  const Pose2 pose = odometry.pose_at(at(12345, 321, 1024));
  EXPECT_NEAR(pose.x_m, 0.0, 1e-12);
  EXPECT_NEAR(pose.y_m, 0.0, 1e-12);
  EXPECT_NEAR(pose.theta_rad, 0.0, 1e-12);
}

TEST_F(Odometry, GoesOnWhereCountsWrapRound) {
  (void)odometry.pose_at(at(0x7FF0, 0x0010, 0));
  const Pose2 pose = odometry.pose_at(at(0x0040, 0x7FF0, 1024));
  EXPECT_NEAR(pose.x_m, 0.080, 1e-9);
  EXPECT_NEAR(pose.y_m, -0.032, 1e-9);
  EXPECT_NEAR(pose.theta_rad, std::numbers::pi / 2, 1e-9);
}

TEST_F(Odometry, GoesOnWhereTheyWrapAtTwelveBits) {
  (void)odometry.pose_at(at(4090, 5, 0));
  const Pose2 pose = odometry.pose_at(at(10, 4000, 0));
  EXPECT_NEAR(pose.x_m, 0.016, 1e-9);
  EXPECT_NEAR(pose.y_m, -0.101, 1e-9);
}

TEST_F(Odometry, ARobotThatCountsAnewStandsWhereItWasLastSeen) {
  (void)odometry.pose_at(at(0, 0, 0));
  const Pose2 before = odometry.pose_at(at(300, 0, 1024));
  odometry.begin_session(*units_of("p3dx-sh"));
  const Pose2 after = odometry.pose_at(at(0, 0, 0));
  EXPECT_NEAR(after.x_m, before.x_m, 1e-9);
  EXPECT_NEAR(after.theta_rad, before.theta_rad, 1e-9);
  const Pose2 on = odometry.pose_at(at(100, 0, 0));
  EXPECT_NEAR(on.x_m, 0.3, 1e-9);
  EXPECT_NEAR(on.y_m, 0.1, 1e-9) << "ahead is where it looked";
}

TEST_F(Odometry, WhatWasDrivenInAGapIsInCountsThatGoOn) {
  (void)odometry.pose_at(at(500, 100, 1024));
  (void)odometry.pose_at(at(500, 400, 1024));
  odometry.begin_session(*units_of("p3dx-sh"));
  const Pose2 after = odometry.pose_at(at(460, 700, 2048));
  EXPECT_NEAR(after.x_m, 0.6, 1e-9) << "ahead is where it looked first";
  EXPECT_NEAR(after.y_m, 0.04, 1e-9);
  EXPECT_NEAR(after.theta_rad, std::numbers::pi / 2, 1e-9);
}

TEST_F(Odometry, CountsThatAreFarFromWhereTheyWereBeginAnew) {
  (void)odometry.pose_at(at(0, 0, 0));
  const Pose2 before = odometry.pose_at(at(300, 0, 1024));
  odometry.begin_session(*units_of("p3dx-sh"));
  const Pose2 after = odometry.pose_at(at(9000, 0, 77));
  EXPECT_NEAR(after.x_m, before.x_m, 1e-9);
  EXPECT_NEAR(after.y_m, before.y_m, 1e-9);
  EXPECT_NEAR(after.theta_rad, before.theta_rad, 1e-9);
}

}  // namespace
}  // namespace cairn::p2os_robot
