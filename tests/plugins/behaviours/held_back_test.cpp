#include "plugins/behaviours/held_back.hpp"

#include <gtest/gtest.h>

namespace cairn::behaviours {
namespace {

const OccupancyGrid kGrid(0.05);
const LandmarkGraph kGraph;
const RobotModel kRobot;

// Seconds until the watch calls the robot stuck, or 60; it moves by actual_mps while it wants wanted.
double stuck_after_s(const Twist& wanted, double actual_mps, double held_back_ratio, bool bumped = false) {
  HeldBackWatch watch(2.5);
  Observation observation;
  observation.bumped = bumped;
  for (int tick = 0; tick < 1500; ++tick) {
    const double time_s = 0.04 * tick;
    const PoseEstimate pose{{actual_mps * time_s, 0.0, 0.0}, Eigen::Matrix3d::Zero()};
    if (watch.is_stuck({kGrid, kGraph, kRobot, pose, time_s, &observation, held_back_ratio}, wanted)) return time_s;
  }
  return 60.0;
}

TEST(HeldBackWatch, IsPatientWithTheStopLayerButNotForEver) {
  EXPECT_NEAR(stuck_after_s({0.2, 0.0}, 0.02, 0.9), 2.5, 0.1);
  EXPECT_EQ(stuck_after_s({0.2, 0.0}, 0.15, 0.25), 60.0);
}

TEST(HeldBackWatch, NoticesARobotThatJustStands) {
  EXPECT_NEAR(stuck_after_s({0.2, 0.0}, 0.0, 0.0), 2.5, 0.1);
}

TEST(HeldBackWatch, HasNothingToSayAboutTurning) {
  EXPECT_EQ(stuck_after_s({0.0, 0.5}, 0.0, 0.0), 60.0);
}

TEST(HeldBackWatch, DoesNotWaitAfterABump) {
  EXPECT_LT(stuck_after_s({0.2, 0.0}, 0.0, 1.0, true), 0.5);
}

}  // namespace
}  // namespace cairn::behaviours
