#include "framework/landmarks/markers/marker_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "framework/landmarks/tracker.hpp"
#include "tests/framework/landmarks/connecting.hpp"

namespace cairn {
namespace {

constexpr MarkerId kSeven{MarkerFamily::tag36h11, 7};
const Pose2 kTruth{4.0, 2.0, radians(180.0)};

Eigen::Matrix3d covariance_of(double position_m, double angle_rad) {
  return Eigen::Vector3d(position_m * position_m, position_m * position_m, angle_rad * angle_rad).asDiagonal();
}

PoseEstimate at(const Pose2& T_map_robot, double position_m = 0.01, double heading_rad = 0.005) {
  PoseEstimate pose;
  pose.T_map_robot = T_map_robot;
  pose.covariance = covariance_of(position_m, heading_rad);
  return pose;
}

MarkerPose seen_from(const Pose2& T_map_robot, const Pose2& T_map_marker, double position_m, double angle_rad) {
  MarkerPose pose;
  pose.T_robot_marker = inverse(T_map_robot) * T_map_marker;
  pose.covariance = covariance_of(position_m, angle_rad);
  return pose;
}

// Turned to the other side of the line of sight.
Pose2 mirrored(const Pose2& T_map_robot, const Pose2& T_map_marker) {
  const Point back = T_map_robot.position() - T_map_marker.position();
  const double sight_rad = std::atan2(back.y(), back.x());
  return {T_map_marker.x_m, T_map_marker.y_m, wrap_angle(2.0 * sight_rad - T_map_marker.theta_rad)};
}

MarkerSighting sighting_of(const MarkerId& marker, const MarkerPose& pose) {
  MarkerSighting sighting;
  sighting.marker = marker;
  sighting.pose = pose;
  return sighting;
}

TEST(MarkerTracker, SightingsFromManyPlacesGiveAPlaceAsGoodAsItsCovarianceSays) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double nees = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    MarkerTracker tracker;
    for (std::size_t i = 0; i < 8; ++i) {
      const Pose2 T_map_robot{1.0 + 0.25 * static_cast<double>(i), 1.5, radians(10.0)};
      const PoseEstimate pose = at({T_map_robot.x_m + 0.01 * normal(random), T_map_robot.y_m + 0.01 * normal(random),
                                    T_map_robot.theta_rad + 0.005 * normal(random)});
      MarkerPose seen = seen_from(T_map_robot, kTruth, 0.04, 0.05);
      seen.T_robot_marker.x_m += 0.04 * normal(random);
      seen.T_robot_marker.y_m += 0.04 * normal(random);
      seen.T_robot_marker.theta_rad += 0.05 * normal(random);
      const MarkerSighting sighting = sighting_of(kSeven, seen);
      (void)tracker.update({&sighting, 1}, pose, i);
    }
    const auto estimate = tracker.estimate(kSeven);
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->sightings, 8);
    const Eigen::Vector3d error(estimate->T_map_marker.x_m - kTruth.x_m, estimate->T_map_marker.y_m - kTruth.y_m,
                                wrap_angle(estimate->T_map_marker.theta_rad - kTruth.theta_rad));
    EXPECT_LT(error.head<2>().norm(), 0.1);
    nees += error.dot(estimate->covariance.ldlt().solve(error));
  }
  EXPECT_LT(nees / kRuns, 3.3) << "larger errors than its covariance says";
  EXPECT_GT(nees / kRuns, 1.0) << "smaller ones by far";
}

TEST(MarkerTracker, FollowsBothPosesOfAnAmbiguousSightingUntilMotionDecides) {
  MarkerTracker tracker;
  const Pose2 truth{4.0, 2.0, radians(160.0)};
  std::size_t number = 0;
  const auto see_from = [&](const Pose2& T_map_robot) {
    MarkerSighting sighting =
        sighting_of(kSeven, seen_from(T_map_robot, mirrored(T_map_robot, truth), 0.05, radians(4.0)));
    sighting.mirrored = seen_from(T_map_robot, truth, 0.05, radians(4.0));  // the true one is the second
    (void)tracker.update({&sighting, 1}, at(T_map_robot), number++);
  };
  see_from({1.0, 2.0, 0.0});
  EXPECT_FALSE(tracker.estimate(kSeven)->is_decided);
  see_from({1.8, 1.4, 0.3});
  see_from({2.4, 1.0, 0.4});
  see_from({3.0, 0.8, 0.8});
  ASSERT_TRUE(tracker.estimate(kSeven)->is_decided);
  EXPECT_NEAR(degrees(tracker.estimate(kSeven)->T_map_marker.theta_rad), 160.0, 2.0);
}

TEST(MarkerTracker, ARobotThatStandsStillLearnsNothingNew) {
  MarkerTracker tracker;
  const Pose2 T_map_robot{1.0, 2.0, 0.0};
  const MarkerSighting sighting = sighting_of(kSeven, seen_from(T_map_robot, kTruth, 0.05, 0.05));
  EXPECT_EQ(tracker.update({&sighting, 1}, at(T_map_robot), 0).size(), 1U);
  EXPECT_TRUE(tracker.update({&sighting, 1}, at(T_map_robot), 1).empty());
  EXPECT_EQ(tracker.estimate(kSeven)->sightings, 1);
}

TEST(MarkerTracker, ANumberThatIsTwiceInAPictureIsLeftOut) {
  MarkerTracker tracker;
  const Pose2 T_map_robot{1.0, 2.0, 0.0};
  const std::vector<MarkerSighting> both{
      sighting_of(kSeven, seen_from(T_map_robot, kTruth, 0.05, 0.05)),
      sighting_of(kSeven, seen_from(T_map_robot, {4.0, 3.0, radians(180.0)}, 0.05, 0.05))};
  EXPECT_TRUE(tracker.update(both, at(T_map_robot), 0).empty());
  EXPECT_FALSE(tracker.estimate(kSeven));
}

TEST(MarkerTracker, AMarkerThatHasBeenHungElsewhereIsFollowedThere) {
  MarkerTracker tracker;
  const Pose2 elsewhere{2.0, 4.0, radians(-90.0)};
  for (std::size_t i = 0; i < 12; ++i) {
    const Pose2 T_map_robot{1.0 + 0.2 * static_cast<double>(i), 1.0, 0.5};
    const MarkerSighting sighting = sighting_of(kSeven, seen_from(T_map_robot, i < 5 ? kTruth : elsewhere, 0.03, 0.05));
    (void)tracker.update({&sighting, 1}, at(T_map_robot), i);
    if (i == 6) {
      EXPECT_NEAR(tracker.estimate(kSeven)->T_map_marker.x_m, kTruth.x_m, 0.01) << "a few may be wrong";
    }
  }
  EXPECT_NEAR(tracker.estimate(kSeven)->T_map_marker.x_m, elsewhere.x_m, 0.01);
}

// The tracker of landmarks.

LandmarkTracker tracker_of_landmarks() {
  LandmarkTracker tracker(LandmarksConfig{}, RobotModel{}, {});
  tracker.expect_markers({{7, "dock"}}, 3);
  return tracker;
}

std::vector<LandmarkTracker::Change> see(LandmarkTracker& tracker, const Pose2& T_map_robot, const MarkerId& marker,
                                         const Pose2& T_map_marker) {
  tracker.record_pose(at(T_map_robot));
  const MarkerSighting sighting = sighting_of(marker, seen_from(T_map_robot, T_map_marker, 0.03, 0.03));
  return tracker.update({&sighting, 1});
}

TEST(MarkerLandmarks, AMarkerIsALandmarkOfItsCategoryAfterSomeSightings) {
  LandmarkTracker tracker = tracker_of_landmarks();
  EXPECT_TRUE(see(tracker, {1.0, 2.0, 0.0}, kSeven, kTruth).empty());
  EXPECT_TRUE(see(tracker, {1.3, 2.0, 0.0}, kSeven, kTruth).empty());
  const auto changes = see(tracker, {1.6, 2.0, 0.0}, kSeven, kTruth);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, LandmarkTracker::ChangeKind::found);
  const Landmark* const dock = tracker.graph().find_by_name("tag 7");
  ASSERT_NE(dock, nullptr);
  EXPECT_EQ(dock->category, "dock");
  EXPECT_NEAR(dock->T_map_landmark.x_m, kTruth.x_m, 1e-6);
  EXPECT_TRUE(see(tracker, {1.9, 2.0, 0.0}, kSeven, kTruth).empty()) << "where it was";
  EXPECT_EQ(tracker.graph().landmarks().size(), 1U);
}

TEST(MarkerLandmarks, AShapeBesideAMarkerIsALandmarkOfItsOwn) {
  LandmarkTracker tracker = tracker_of_landmarks();
  for (const double x_m : {1.0, 1.3, 1.6}) (void)see(tracker, {x_m, 2.0, 0.0}, kSeven, kTruth);
  Matching matching;
  Detection detection;
  detection.category = "square";
  detection.T_map_landmark = {4.1, 2.0, 0.0};
  detection.degree = 0.9;
  detection.templates = {{"square", 0.0, 0.9}};
  matching.detection = detection;
  matching.degrees = {{"square", 0.9, 0.0, {4.1, 2.0}}};
  for (int i = 0; i < 4; ++i) (void)tracker.update(matching);
  EXPECT_EQ(tracker.graph().landmarks().size(), 2U);
  EXPECT_EQ(tracker.graph().find_by_name("tag 7")->category, "dock");
}

TEST(MarkerLandmarks, MoveWithTheRobotsPathWhenItIsCorrected) {
  LandmarkTracker tracker = tracker_of_landmarks();
  std::vector<Pose2> before;
  std::vector<Pose2> corrected;
  for (const double x_m : {1.0, 1.3, 1.6}) {
    (void)see(tracker, {x_m, 2.0, 0.0}, kSeven, kTruth);
    before.push_back({x_m, 2.0, 0.0});
    corrected.push_back({x_m + 0.5, 2.2, 0.0});
  }
  const std::vector<LandmarkTracker::Change> changes = tracker.move({before, corrected});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, LandmarkTracker::ChangeKind::changed);
  EXPECT_NEAR(tracker.graph().find_by_name("tag 7")->T_map_landmark.x_m, kTruth.x_m + 0.5, 0.01);
  EXPECT_NEAR(tracker.graph().find_by_name("tag 7")->T_map_landmark.y_m, kTruth.y_m + 0.2, 0.01);
}

TEST(MarkerLandmarks, RoutesToThemMoveWithTheMap) {
  LandmarkTracker tracker = tracker_of_landmarks();
  std::vector<Pose2> before;
  for (const double x_m : {1.0, 1.3, 1.6}) {
    (void)see(tracker, {x_m, 2.0, 0.0}, kSeven, kTruth);
    before.push_back({x_m, 2.0, 0.0});
  }
  OccupancyGrid grid(0.1);
  fill(grid, {{0, 0}, {60, 40}}, -1000);
  Matching matching;
  Detection detection;
  detection.category = "square";
  detection.T_map_landmark = {1.0, 0.8, 0.0};
  detection.degree = 0.9;
  detection.templates = {{"square", 0.0, 0.9}};
  matching.detection = detection;
  matching.degrees = {{"square", 0.9, 0.0, {1.0, 0.8}}};
  for (int i = 0; i < 4; ++i) (void)tracker.update(matching);
  ASSERT_EQ(tracker.graph().landmarks().size(), 2U);
  const RobotModel robot;
  PoseEstimate pose;
  pose.T_map_robot = before.back();
  GridPlanner planner(grid, robot.radius_m);
  tracker.connect({grid, tracker.graph(), robot, pose}, std::ref(planner), 1);
  ASSERT_FALSE(tracker.graph().routes().empty());
  const Route route = tracker.graph().routes().begin()->second;
  const std::optional<Pose2> access = tracker.graph().find_by_name("tag 7")->access;
  std::vector<Pose2> after = before;
  for (Pose2& moved : after) moved = Pose2{0.5, 0.4, 0.0} * moved;
  (void)tracker.move({before, after});
  const Route* const moved = tracker.graph().find_route(route.id);
  ASSERT_NE(moved, nullptr);
  for (const auto& [was, is] : {std::pair(route.trajectory.front(), moved->trajectory.front()),
                                std::pair(route.trajectory.back(), moved->trajectory.back())})
    EXPECT_NEAR((is.position() - was.position() - Point(0.5, 0.4)).norm(), 0.0, 0.02);
  ASSERT_TRUE(access);
  EXPECT_NEAR((tracker.graph().find_by_name("tag 7")->access->position() - access->position() - Point(0.5, 0.4)).norm(),
              0.0, 0.02);
}

}  // namespace
}  // namespace cairn
