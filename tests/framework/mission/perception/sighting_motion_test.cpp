#include "framework/mission/perception/sighting_motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cairn {
namespace {

constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

// A marker 2 m ahead that faces the robot, known better across than along.
MarkerSighting ahead_at(double stamp_s) {
  MarkerSighting sighting;
  sighting.stamp_s = stamp_s;
  sighting.pose.T_robot_marker = {2.0, 0.0, std::numbers::pi};
  sighting.pose.covariance.diagonal() << 4.0, 1.0, 0.5;
  sighting.mirrored = sighting.pose;
  return sighting;
}

TEST(SightingMotion, APictureOfBeforeATurnIsSeenFromAfterIt) {
  SightingMotion motion;
  motion.add(1.0, {});
  motion.add(2.0, {0.0, 0.0, kQuarter_rad});
  motion.add(2.5, {0.0, 0.5, kQuarter_rad});
  MarkerSighting sighting = ahead_at(1.0 + 1e-12);
  motion.bring_to_now(sighting);
  for (const MarkerPose& pose : {sighting.pose, *sighting.mirrored}) {
    EXPECT_NEAR(pose.T_robot_marker.x_m, -0.5, 1e-9) << "it has driven half a metre on after the turn to the left";
    EXPECT_NEAR(pose.T_robot_marker.y_m, -2.0, 1e-9);
    EXPECT_NEAR(pose.T_robot_marker.theta_rad, kQuarter_rad, 1e-9);
    EXPECT_NEAR(pose.covariance(0, 0), 1.0, 1e-9);
    EXPECT_NEAR(pose.covariance(1, 1), 4.0, 1e-9);
    EXPECT_NEAR(pose.covariance(2, 2), 0.5, 1e-9);
  }
}

TEST(SightingMotion, BetweenTwoPosesTheRobotWasInBetween) {
  SightingMotion motion;
  motion.add(1.0, {1.0, 0.0, 0.0});
  motion.add(2.0, {3.0, 0.0, 0.0});
  MarkerSighting sighting = ahead_at(1.25);
  motion.bring_to_now(sighting);
  EXPECT_NEAR(sighting.pose.T_robot_marker.x_m, 0.5, 1e-12);
}

TEST(SightingMotion, OfNowAndOfAnUnknownPastStayAsTheyAre) {
  SightingMotion motion;
  MarkerSighting sighting = ahead_at(2.0);
  motion.bring_to_now(sighting);
  motion.add(1.0, {});
  motion.add(2.0, {1.0, 0.0, 0.0});
  motion.bring_to_now(sighting);
  EXPECT_EQ(sighting.pose.T_robot_marker.x_m, 2.0);
  motion.add(9.0, {5.0, 0.0, 0.0});
  motion.bring_to_now(sighting);
  EXPECT_EQ(sighting.pose.T_robot_marker.x_m, 2.0);
}

}  // namespace
}  // namespace cairn
