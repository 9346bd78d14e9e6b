#include "plugins/behaviours/driving/route_goal.hpp"

#include <gtest/gtest.h>

namespace cairn::behaviours {
namespace {

Place landmarks(std::vector<LandmarkId> ids) {
  return {std::nullopt, false, std::move(ids)};
}

TEST(RouteGoal, APlaceIsItsOwnPoint) {
  RouteGoal goal;
  goal.set({Pose2{1.0, 2.0, 0.0}, false, {}});
  EXPECT_TRUE(goal.is_exact());
  EXPECT_EQ(*goal.point(LandmarkGraph()), Point(1.0, 2.0));
  EXPECT_EQ(goal.landmark(), 0);
}

TEST(RouteGoal, OfLandmarksIsGuessedUntilARouteIsPlanned) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.T_map_landmark = {3.0, 1.0, 0.0};
  const LandmarkId id = graph.add(landmark);
  RouteGoal goal;
  goal.set(landmarks({id}));
  EXPECT_FALSE(goal.is_exact());
  EXPECT_EQ(*goal.point(graph), Point(3.0, 1.0));

  PlanResult result;
  result.landmarks = {7, id, 9};
  goal.record(result, {{0.0, 0.0}, {2.0, 1.0}});
  EXPECT_TRUE(goal.is_exact());
  EXPECT_EQ(*goal.point(graph), Point(2.0, 1.0));
  EXPECT_EQ(goal.landmark(), id) << "the last of the route that is a goal";
}

TEST(RouteGoal, OfAnUnknownLandmarkIsNowhere) {
  RouteGoal goal;
  goal.set(landmarks({5}));
  EXPECT_FALSE(goal.point(LandmarkGraph()));
}

}  // namespace
}  // namespace cairn::behaviours
