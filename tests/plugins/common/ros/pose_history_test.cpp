#include "plugins/common/ros/pose_history.hpp"

#include <gtest/gtest.h>

namespace cairn::ros {
namespace {

TEST(PoseHistory, IsBetweenWhatIsKnownAndNearestAtItsEnds) {
  PoseHistory history;
  EXPECT_FALSE(history.at(1.0));
  history.add(1.0, {0.0, 0.0, 0.0});
  history.add(2.0, {1.0, 0.0, 0.4});
  EXPECT_DOUBLE_EQ(history.at(1.5)->x_m, 0.5);
  EXPECT_DOUBLE_EQ(history.at(1.5)->theta_rad, 0.2);
  EXPECT_DOUBLE_EQ(history.at(0.0)->x_m, 0.0);
  EXPECT_DOUBLE_EQ(history.at(9.0)->x_m, 1.0);
}

TEST(PoseHistory, ForgetsWhatWasBeforeAClockWasSet) {
  PoseHistory history;
  history.add(100.0, {5.0, 0.0, 0.0});
  history.add(1.0, {6.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(history.at(50.0)->x_m, 6.0);
}

TEST(PoseHistory, KeepsTwoSeconds) {
  PoseHistory history;
  for (int i = 0; i <= 50; ++i) history.add(0.1 * i, {0.1 * i, 0.0, 0.0});
  EXPECT_NEAR(history.at(0.0)->x_m, 3.0, 0.11);
  EXPECT_NEAR(history.at(4.05)->x_m, 4.05, 1e-9);
}

}  // namespace
}  // namespace cairn::ros
