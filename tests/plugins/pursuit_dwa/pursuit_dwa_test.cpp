#include "plugins/pursuit_dwa/pursuit_dwa.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cairn::pursuit_dwa {
namespace {

const OccupancyGrid kGrid(0.05);
const LandmarkGraph kGraph;
const RobotModel kRobot;
const std::vector<Point> kAhead{{0.0, 0.0}, {2.0, 0.0}};

ControlResult control(const ControlRequest& request, const PursuitDwaConfig& config = {}) {
  PursuitDwa controller(config);
  return controller.control(request, {kGrid, kGraph, kRobot, {}, 0.0});
}

ControlRequest request_for(const std::vector<Point>& path) {
  ControlRequest request;
  request.path = path;
  request.speed_mps = 0.25;
  request.velocity = {0.25, 0.0};
  request.period_s = 0.04;
  return request;
}

TEST(PursuitDwa, ItsTwistKeepsToTheAccelerationsFromTheVelocityGiven) {
  ControlRequest request = request_for(kAhead);
  request.velocity = {};
  const ControlResult result = control(request);
  EXPECT_EQ(result.state, ControlState::following);
  EXPECT_NEAR(result.twist.v_mps, kRobot.max_acceleration_mps2 * 0.04, 1e-12);
  EXPECT_NEAR(result.unhindered.v_mps, 0.25, 1e-12) << "what the path alone asks for";
}

TEST(PursuitDwa, ASpeedLimitSlowsItDownAndKeepsTheLookahead) {
  ControlRequest request = request_for(kAhead);
  request.speed_limit_mps = 0.05;
  EXPECT_DOUBLE_EQ(control(request).unhindered.v_mps, 0.05);
}

TEST(PursuitDwa, SaysWhenNothingLeadsOn) {
  std::vector<Point> wall;
  for (double y = -1.5; y < 1.5; y += 0.05) wall.emplace_back(0.26, y);
  ControlRequest request = request_for(kAhead);
  request.obstacles = wall;
  const ControlResult result = control(request);
  EXPECT_EQ(result.state, ControlState::blocked);
  EXPECT_LT(result.twist.v_mps, 0.25);
  EXPECT_GT(result.unhindered.v_mps, 0.2) << "progress is measured against it";
}

TEST(PursuitDwa, FollowsExactlyWhereObstaclesDoNotCount) {
  const std::vector<Point> post{{0.3, 0.0}};
  ControlRequest request = request_for(kAhead);
  request.obstacles = post;
  request.avoids_obstacles = false;
  const ControlResult result = control(request);
  EXPECT_EQ(result.state, ControlState::following);
  EXPECT_EQ(result.twist, result.unhindered);
}

TEST(PursuitDwa, ComesToAStopWithinTheAccelerationsWhenItHasArrived) {
  ControlRequest request = request_for({});
  const ControlResult result = control(request);
  EXPECT_EQ(result.state, ControlState::arrived);
  EXPECT_NEAR(result.twist.v_mps, 0.25 - kRobot.max_acceleration_mps2 * 0.04, 1e-12);
}

TEST(PursuitDwa, ItsSettingsCount) {
  const std::vector<Point> post{{0.5, 0.32}};
  ControlRequest request = request_for(kAhead);
  request.obstacles = post;
  PursuitDwaConfig config;
  EXPECT_EQ(control(request, config).unhindered.w_radps, control(request, config).twist.w_radps) << "beside it";
  config.avoid.clearance_m = 0.3;
  EXPECT_NE(control(request, config).twist.w_radps, 0.0) << "too near with more clearance";
}

}  // namespace
}  // namespace cairn::pursuit_dwa
