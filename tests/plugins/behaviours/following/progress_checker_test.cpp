#include "plugins/behaviours/following/progress_checker.hpp"

#include <gtest/gtest.h>

namespace cairn::behaviours {
namespace {

const OccupancyGrid kGrid(0.05);
const LandmarkGraph kGraph;
const RobotModel kRobot;

// Seconds until the watch calls the robot stuck, or 60; it moves as actual says while it wants wanted.
double stuck_after_s(const Twist& wanted, const Twist& actual, double speed_reduction_ratio, bool bumped = false) {
  ProgressChecker watch(2.5);
  Observation observation;
  observation.bumped = bumped;
  for (int tick = 0; tick < 1500; ++tick) {
    const double time_s = 0.04 * tick;
    const PoseEstimate pose{{actual.v_mps * time_s, 0.0, wrap_angle(actual.w_radps * time_s)}, Eigen::Matrix3d::Zero()};
    if (watch.is_stuck({kGrid, kGraph, kRobot, pose, time_s, &observation, speed_reduction_ratio}, wanted))
      return time_s;
  }
  return 60.0;
}

TEST(ProgressChecker, IsPatientWithTheStopLayerButNotForEver) {
  EXPECT_NEAR(stuck_after_s({0.2, 0.0}, {0.02, 0.0}, 0.9), 2.5, 0.1);
  EXPECT_EQ(stuck_after_s({0.2, 0.0}, {0.15, 0.0}, 0.25), 60.0);
}

TEST(ProgressChecker, NoticesARobotThatJustStands) {
  EXPECT_NEAR(stuck_after_s({0.2, 0.0}, {}, 0.0), 2.5, 0.1);
}

TEST(ProgressChecker, NoticesATurnInPlaceThatDoesNotHappen) {
  EXPECT_NEAR(stuck_after_s({0.0, 0.5}, {}, 0.0), 2.5, 0.1);
  EXPECT_NEAR(stuck_after_s({0.0, -0.5}, {0.0, -0.1}, 0.8), 2.5, 0.1) << "the stop layer cuts it";
  EXPECT_EQ(stuck_after_s({0.0, -0.5}, {0.0, -0.4}, 0.2), 60.0);
}

TEST(ProgressChecker, HasNothingToSayAboutBackingAndStanding) {
  EXPECT_EQ(stuck_after_s({-0.2, 0.0}, {}, 1.0), 60.0);
  EXPECT_EQ(stuck_after_s({}, {}, 0.0), 60.0);
}

TEST(ProgressChecker, DoesNotWaitAfterABump) {
  EXPECT_LT(stuck_after_s({0.2, 0.0}, {}, 1.0, true), 0.5);
  EXPECT_EQ(stuck_after_s({0.0, 0.5}, {0.0, 0.4}, 0.0, true), 60.0) << "it turns away from it";
}

}  // namespace
}  // namespace cairn::behaviours
