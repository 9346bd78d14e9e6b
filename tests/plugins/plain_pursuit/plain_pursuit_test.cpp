#include "plugins/plain_pursuit/plain_pursuit.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cairn::plain_pursuit {
namespace {

const std::vector<Point> kAhead{{0.0, 0.0}, {2.0, 0.0}};

ControlResult control(const std::vector<Point>& obstacles, const Pose2& T_map_robot = {}) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  ControlRequest request;
  request.path = kAhead;
  request.obstacles = obstacles;
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

TEST(PlainPursuit, TurnsInPlaceWhereThePathLeadsBack) {
  const ControlResult result = control({}, {0.0, 0.0, 3.0});
  EXPECT_EQ(result.twist.v_mps, 0.0);
  EXPECT_NE(result.twist.w_radps, 0.0);
  EXPECT_TRUE(result.progress.turning);
}

}  // namespace
}  // namespace cairn::plain_pursuit
