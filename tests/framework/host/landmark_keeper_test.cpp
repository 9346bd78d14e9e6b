#include "framework/host/landmark_keeper.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Detection detection_at(double x_m, double y_m, const std::string& category, double degree) {
  Detection detection;
  detection.category = category;
  detection.T_map_landmark = {x_m, y_m, 0.0};
  detection.degree = degree;
  return detection;
}

// Answers every request with the straight line.
class StraightPlanner : public Planner {
 public:
  PlanResult plan(const PlanRequest& request, const WorldView&, const Budget&) const override {
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, *request.to.pose};
    result.length_m = (request.from.pose->position() - request.to.pose->position()).norm();
    return result;
  }
};

// A free floor of 6 x 4 m with two occupied blocks of 0.4 m at (1.5, 2) and (4.5, 2).
OccupancyGrid floor_with_two_blocks() {
  OccupancyGrid grid(0.1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool block = y >= 18 && y < 22 && ((x >= 13 && x < 17) || (x >= 43 && x < 47));
      grid.set_log_odds({x, y}, block ? 1000 : -1000);
    }
  return grid;
}

class LandmarkKeeperTest : public testing::Test {
 protected:
  RobotModel robot_;
  LandmarkKeeper keeper_{{.confirm_sightings = 1}, robot_};
  OccupancyGrid grid_ = floor_with_two_blocks();

  void connect() {
    PoseEstimate pose;
    pose.T_map_robot = {3.0, 1.0, 0.0};
    const LandmarkGraph graph = keeper_.graph();
    keeper_.connect({grid_, graph, robot_, pose, 0.0, nullptr, 0.0}, StraightPlanner{}, {}, 1);
  }
};

TEST_F(LandmarkKeeperTest, ADetectionNearALandmarkIsThatLandmark) {
  EXPECT_TRUE(keeper_.fold(detection_at(1.5, 2.0, "square", 0.6)).is_new);
  const auto change = keeper_.fold(detection_at(1.6, 2.1, "square", 0.5));
  EXPECT_FALSE(change.is_new);
  EXPECT_FALSE(change.improved);
  EXPECT_EQ(keeper_.graph().landmarks().size(), 1U);
  EXPECT_EQ(keeper_.graph().find(1)->sightings, 2);
  EXPECT_DOUBLE_EQ(keeper_.graph().find(1)->T_map_landmark.x_m, 1.5);
}

TEST_F(LandmarkKeeperTest, ABetterDegreeCorrectsPlaceAndCategoryButKeepsTheId) {
  keeper_.fold(detection_at(1.5, 2.0, "triangle", 0.6));
  EXPECT_TRUE(keeper_.fold(detection_at(1.55, 2.0, "square", 0.8)).improved);
  EXPECT_EQ(keeper_.graph().find(1)->category, "square");
  EXPECT_DOUBLE_EQ(keeper_.graph().find(1)->T_map_landmark.x_m, 1.55);
}

TEST_F(LandmarkKeeperTest, ADetectionFarAwayIsANewLandmark) {
  keeper_.fold(detection_at(1.5, 2.0, "square", 0.6));
  EXPECT_TRUE(keeper_.fold(detection_at(4.5, 2.0, "square", 0.6)).is_new);
  EXPECT_EQ(keeper_.graph().landmarks().size(), 2U);
}

TEST_F(LandmarkKeeperTest, WhatIsSeenTooSeldomIsNoLandmark) {
  LandmarkKeeper keeper({.confirm_sightings = 3}, robot_);
  EXPECT_EQ(keeper.fold(detection_at(1.5, 2.0, "square", 0.6)).landmark, 0);
  EXPECT_FALSE(keeper.fold(detection_at(1.55, 2.0, "circle", 0.7)).is_new);
  EXPECT_EQ(keeper.fold(detection_at(4.5, 2.0, "square", 0.6)).landmark, 0) << "another place, its first sighting";
  EXPECT_TRUE(keeper.graph().landmarks().empty());
  const auto third = keeper.fold(detection_at(1.5, 2.0, "square", 0.6));
  EXPECT_TRUE(third.is_new);
  ASSERT_NE(keeper.graph().find(third.landmark), nullptr);
  EXPECT_EQ(keeper.graph().find(third.landmark)->category, "circle") << "the best of the three";
  EXPECT_EQ(keeper.graph().find(third.landmark)->sightings, 3);
  EXPECT_EQ(keeper.graph().landmarks().size(), 1U);
}

TEST_F(LandmarkKeeperTest, ConnectFindsStandingPlacesThatFitTheRobotAndLookAtTheLandmark) {
  keeper_.fold(detection_at(1.5, 2.0, "square", 0.6));
  connect();
  const Landmark& landmark = *keeper_.graph().find(1);
  ASSERT_TRUE(landmark.access);
  const Point to_landmark = landmark.T_map_landmark.position() - landmark.access->position();
  EXPECT_GE(to_landmark.norm(), 0.2 + robot_.radius_m);
  EXPECT_LE(to_landmark.norm(), 0.7);
  EXPECT_NEAR(to_landmark.normalized().dot(landmark.access->direction()), 1.0, 1e-9);
}

TEST_F(LandmarkKeeperTest, PlannedRoutesJoinBothWays) {
  keeper_.fold(detection_at(1.5, 2.0, "square", 0.6));
  keeper_.fold(detection_at(4.5, 2.0, "circle", 0.6));
  connect();
  ASSERT_NE(keeper_.graph().route_between(1, 2), nullptr);
  ASSERT_NE(keeper_.graph().route_between(2, 1), nullptr);
  EXPECT_FALSE(keeper_.graph().route_between(1, 2)->driven);
  EXPECT_EQ(keeper_.graph().routes().size(), 2U);
}

TEST_F(LandmarkKeeperTest, AWayThatTheRobotDroveIsPreferredToAPlannedOne) {
  keeper_.fold(detection_at(1.5, 2.0, "square", 0.6));
  keeper_.fold(detection_at(4.5, 2.0, "circle", 0.6));
  connect();
  const Pose2 from = *keeper_.graph().find(1)->access;
  const Pose2 to = *keeper_.graph().find(2)->access;
  for (double s = 0.0; s <= 1.0; s += 0.01)
    keeper_.follow({from.x_m + s * (to.x_m - from.x_m), from.y_m + s * (to.y_m - from.y_m), 0.0});
  connect();
  const Route& route = *keeper_.graph().route_between(1, 2);
  EXPECT_TRUE(route.driven);
  EXPECT_GT(route.trajectory.size(), 20U);
  EXPECT_EQ(route.trajectory.front(), from);
  EXPECT_EQ(route.trajectory.back(), to);
}

}  // namespace
}  // namespace cairn
