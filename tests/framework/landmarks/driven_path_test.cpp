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

// Rounds in a room of 4 x 3 m with square corners, the start in the middle of it.
DrivenPath rounds(int count, std::size_t max_poses) {
  DrivenPath driven(max_poses);
  for (double y_m = 1.5; y_m > 0.0; y_m -= 0.05) driven.record({2.0, y_m, -1.57});
  for (double x_m = 2.0; x_m > 0.0; x_m -= 0.05) driven.record({x_m, 0.0, 3.14});
  for (int i = 0; i < count; ++i) {
    for (double x_m = 0.0; x_m < 4.0; x_m += 0.05) driven.record({x_m, 0.0, 0.0});
    for (double y_m = 0.0; y_m < 3.0; y_m += 0.05) driven.record({4.0, y_m, 1.57});
    for (double x_m = 4.0; x_m > 0.0; x_m -= 0.05) driven.record({x_m, 3.0, 3.14});
    for (double y_m = 3.0; y_m > 0.0; y_m -= 0.05) driven.record({0.0, y_m, -1.57});
  }
  return driven;
}

TEST(DrivenPath, HasNoMorePosesThanAllowedHoweverFarTheRobotDrives) {
  const DrivenPath driven = rounds(500, 1000);  // 7 km
  EXPECT_LE(driven.poses().size(), 1000U);
  EXPECT_GE(driven.poses().size(), 700U);
  EXPECT_EQ(driven.poses().front(), (Pose2{2.0, 1.5, -1.57})) << "where the mission began";
}

TEST(DrivenPath, UpToTheBoundEveryPoseStays) {
  EXPECT_EQ(rounds(3, 1000).poses(), rounds(3, 100000).poses());
}

TEST(DrivenPath, ThinningLeavesOutStraightPiecesAndNoCorner) {
  const std::vector<Pose2> whole = rounds(10, 100000).poses();
  const std::vector<Pose2> thinned = rounds(10, 2000).poses();
  ASSERT_GT(whole.size(), 2000U);
  ASSERT_LE(thinned.size(), 2000U);
  for (std::size_t i = 1; i < thinned.size(); ++i)
    EXPECT_LE((thinned[i].position() - thinned[i - 1].position()).norm(), 0.2 + 1e-9) << i;
  double whole_m = 0.0;
  double thinned_m = 0.0;
  for (std::size_t i = 1; i < whole.size(); ++i) whole_m += (whole[i].position() - whole[i - 1].position()).norm();
  for (std::size_t i = 1; i < thinned.size(); ++i)
    thinned_m += (thinned[i].position() - thinned[i - 1].position()).norm();
  EXPECT_NEAR(thinned_m, whole_m, 1e-3 * whole_m) << "nothing is forgotten yet, and no corner is cut";
}

TEST(DrivenPath, ThePlacesThatWereLastPassedAreFoundInAThinnedPathToo) {
  const DrivenPath driven = rounds(500, 1000);
  const std::vector<Pose2> stretch = driven.between({3.0, 0.1, 0.0}, {3.9, 1.0, 1.57});
  ASSERT_GE(stretch.size(), 8U);
  for (const Pose2& pose : stretch) EXPECT_GE(pose.x_m, 2.5) << "the short way round the corner";
}

// The start is far from the oldest pose that is left: the robot has not driven straight from one to the other.
TEST(DrivenPath, NoStretchLeadsAcrossWhatIsForgotten) {
  const DrivenPath driven = rounds(500, 1000);
  ASSERT_GT((driven.poses()[1].position() - driven.poses()[0].position()).norm(), 0.25);
  for (const Pose2& to : {Pose2{0.0, 0.0, 0.0}, Pose2{4.0, 3.0, 0.0}, Pose2{2.0, 0.0, 0.0}})
    EXPECT_TRUE(driven.between({2.0, 1.5, 0.0}, to).empty());
}

// Half as many poses a metre do not make a stretch half as long.
TEST(DrivenPath, OfAThinnedAndADenseStretchTheShorterOneIsTaken) {
  std::vector<Pose2> poses;
  for (double x_m = 0.0; x_m < 2.0; x_m += 0.2) poses.push_back({x_m, 0.0, 0.0});
  for (double y_m = 0.0; y_m < 1.0; y_m += 0.2) poses.push_back({2.0, y_m, 0.0});
  for (double x_m = 2.0; x_m > 0.0; x_m -= 0.2) poses.push_back({x_m, 1.0, 0.0});
  for (double y_m = 1.0; y_m > 0.0; y_m -= 0.05) poses.push_back({0.0, y_m, 0.0});
  const DrivenPath driven(poses, 1000);
  for (const Pose2& pose : driven.between({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0})) EXPECT_LE(pose.x_m, 0.3);
}

TEST(DrivenPath, AfterAResumeItIsThinnedAsWithout) {
  const DrivenPath driven = rounds(30, 1000);
  DrivenPath resumed(driven.poses(), 1000);
  DrivenPath longer(rounds(3, 100000).poses(), 500);
  EXPECT_EQ(resumed.poses(), driven.poses());
  longer.record({9.0, 9.0, 0.0});
  EXPECT_LE(longer.poses().size(), 500U) << "of a map that was made with a higher bound";
}

}  // namespace
}  // namespace cairn
