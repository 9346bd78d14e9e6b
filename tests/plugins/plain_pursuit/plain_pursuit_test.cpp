#include "plugins/plain_pursuit/plain_pursuit.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cairn::plain_pursuit {
namespace {

const std::vector<Point> kAhead{{0.0, 0.0}, {2.0, 0.0}};

// Obstacles in the map frame.
ControlResult control(const std::vector<Point>& obstacles, const Pose2& T_map_robot = {},
                      const std::vector<Point>& path = kAhead) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  ControlRequest request;
  request.path = path;
  std::vector<Point> obstacles_robot;
  for (const Point& p : obstacles) obstacles_robot.push_back(inverse(T_map_robot) * p);
  request.obstacles = obstacles_robot;
  PlainPursuit controller{PlainPursuitConfig{}};
  return controller.control(request, {grid, graph, robot, {T_map_robot, {}}, 0.0});
}

TEST(PlainPursuit, DrivesAlongItsPath) {
  const ControlResult result = control({});
  EXPECT_EQ(result.state, ControlState::following);
  EXPECT_NEAR(result.twist.v_mps, 0.2, 1e-12);
  EXPECT_NEAR(result.twist.w_radps, 0.0, 1e-12);
  EXPECT_GT(control({}, {0.0, -0.1, 0.0}).twist.w_radps, 0.0) << "back to the path";
}

TEST(PlainPursuit, StopsBeforeWhatIsAheadAndSaysWhatItWouldDo) {
  const ControlResult result = control({{0.4, 0.1}});
  EXPECT_EQ(result.state, ControlState::blocked);
  EXPECT_EQ(result.twist, Twist{});
  EXPECT_GT(result.unhindered.v_mps, 0.1);
}

TEST(PlainPursuit, WhatIsBesideOrBehindDoesNotStopIt) {
  EXPECT_EQ(control({{0.4, 0.5}, {-0.3, 0.0}, {1.5, 0.0}}).state, ControlState::following);
}

TEST(PlainPursuit, WhatItStandsBesideDoesNotStopItFromPassing) {
  const RobotModel robot;
  EXPECT_EQ(control({{0.0, robot.radius_m + 0.02}, {-0.1, -robot.radius_m}}).state, ControlState::following);
  EXPECT_EQ(control({{0.1, 0.0}}).state, ControlState::blocked) << "driving on leads nearer to it";
}

TEST(PlainPursuit, WhatIsBehindTheEndOfItsPathDoesNotStopIt) {
  const RobotModel robot;
  const Point behind_end{2.0 + robot.radius_m + 0.1, 0.0};
  EXPECT_EQ(control({behind_end}, {1.8, 0.0, 0.0}).state, ControlState::following);
}

TEST(PlainPursuit, WhatIsStraightAheadDoesNotStopItWhereThePathTurnsAway) {
  const std::vector<Point> bend{{0.0, 0.0}, {0.1, 0.0}, {0.1, 2.0}};
  EXPECT_EQ(control({{0.36, 0.36}}, {0.0, 0.0, radians(45.0)}, bend).state, ControlState::following);
  EXPECT_EQ(control({{0.0, 0.42}}, {0.0, 0.0, radians(45.0)}, bend).state, ControlState::blocked);
}

TEST(PlainPursuit, TurnsInPlaceWhereThePathLeadsBack) {
  const ControlResult result = control({}, {0.0, 0.0, 3.0});
  EXPECT_EQ(result.twist.v_mps, 0.0);
  EXPECT_NE(result.twist.w_radps, 0.0);
  EXPECT_TRUE(result.progress.turning);
}

}  // namespace
}  // namespace cairn::plain_pursuit
