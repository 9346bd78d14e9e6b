#include "framework/landmarks/driven_path.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cairn {
namespace {

DrivenPath straight_to(double x_m) {
  DrivenPath driven;
  for (int i = 0; 0.01 * i <= x_m; ++i) driven.record({0.01 * i, 0.0, 0.0});
  return driven;
}

TEST(DrivenPath, KeepsOnePoseEachFiveCentimetres) {
  const DrivenPath driven = straight_to(1.0);
  ASSERT_GE(driven.poses().size(), 17U);
  ASSERT_LE(driven.poses().size(), 21U);
  for (std::size_t i = 1; i < driven.poses().size(); ++i)
    EXPECT_GE(driven.poses()[i].x_m - driven.poses()[i - 1].x_m, 0.05 - 1e-9);
}

TEST(DrivenPath, AStretchBeginsAndEndsAtThePlacesThemselves) {
  const Pose2 from{0.2, 0.1, 0.0};
  const Pose2 to{0.8, -0.1, 1.0};
  const std::vector<Pose2> stretch = straight_to(1.0).between(from, to);
  ASSERT_GE(stretch.size(), 3U);
  EXPECT_EQ(stretch.front(), from);
  EXPECT_EQ(stretch.back(), to);
}

TEST(DrivenPath, AStretchTheOtherWayRoundIsTurned) {
  const std::vector<Pose2> stretch = straight_to(1.0).between({0.9, 0.0, 0.0}, {0.1, 0.0, 0.0});
  ASSERT_GE(stretch.size(), 4U);
  for (std::size_t i = 2; i + 1 < stretch.size(); ++i) EXPECT_LT(stretch[i].x_m, stretch[i - 1].x_m);
  EXPECT_NEAR(std::abs(stretch[1].theta_rad), std::numbers::pi, 1e-9);
}

TEST(DrivenPath, OfARoundTheShorterHalfIsTaken) {
  DrivenPath driven = straight_to(3.0);
  for (int i = 0; i <= 100; ++i) driven.record({3.0, 0.01 * i, 0.0});
  for (int i = 300; i >= 0; --i) driven.record({0.01 * i, 1.0, 0.0});
  for (const Pose2& pose : driven.between({2.8, 0.0, 0.0}, {2.8, 1.0, 0.0})) EXPECT_GE(pose.x_m, 2.5);
}

TEST(DrivenPath, BetweenPlacesThatWereNotBothPassedThereIsNone) {
  EXPECT_TRUE(straight_to(1.0).between({0.2, 0.0, 0.0}, {2.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(DrivenPath().between({0.2, 0.0, 0.0}, {0.4, 0.0, 0.0}).empty());
}

}  // namespace
}  // namespace cairn
