#include "plugins/common/sonar_model/cleared_footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cairn::sonar_model {
namespace {

RobotModel round_robot(double radius_m) {
  RobotModel robot;
  robot.radius_m = radius_m;
  return robot;
}

void mark(OccupancyGrid& grid, std::span<const Cell> cells) {
  for (const Cell cell : cells) grid.set_log_odds(cell, ClearedFootprint::kFree);
}

TEST(ClearedFootprint, IsWhatTheRobotCoversAndACellBeside) {
  const OccupancyGrid grid(0.05);
  ClearedFootprint room(round_robot(0.22));
  const Pose2 at{1.01, -0.33, 0.7};
  const std::span<const Cell> under = room.unknown_under(grid, at);
  const CellBox box = CellBox{grid.cell_at(at.position()), grid.cell_at(at.position()) + Cell{1, 1}}.grown(10);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const bool is_near = (grid.centre_of({x, y}) - at.position()).norm() <= 0.27;
      EXPECT_EQ(std::ranges::find(under, Cell{x, y}) != under.end(), is_near) << x << " " << y;
    }
  EXPECT_EQ(OccupancyThresholds{}.state(ClearedFootprint::kFree), CellState::free);
}

TEST(ClearedFootprint, LeavesWhatTheMapKnowsAsItIs) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 900);
  grid.set_log_odds({1, 0}, -900);
  grid.set_log_odds({2, 0}, 100);
  grid.set_log_odds({5, 0}, 50);
  ClearedFootprint room(round_robot(0.2));
  const std::span<const Cell> under = room.unknown_under(grid, {0.05, 0.0, 0.0});
  EXPECT_EQ(std::ranges::count(under, Cell{0, 0}), 0);
  EXPECT_EQ(std::ranges::count(under, Cell{1, 0}), 0);
  EXPECT_EQ(std::ranges::count(under, Cell{2, 0}), 1) << "not known well enough";
  EXPECT_EQ(std::ranges::count(under, Cell{5, 0}), 0) << "beside the robot, and rather occupied";
  EXPECT_EQ(std::ranges::count(under, Cell{5, -1}), 1);
}

TEST(ClearedFootprint, GrowsWithTheWay) {
  OccupancyGrid grid(0.05);
  ClearedFootprint room(round_robot(0.2));
  mark(grid, room.unknown_under(grid, {}));
  EXPECT_TRUE(room.unknown_under(grid, {0.02, 0.0, 0.0}).empty()) << "less than half a cell";
  const std::span<const Cell> ahead = room.unknown_under(grid, {0.1, 0.0, 0.0});
  ASSERT_FALSE(ahead.empty());
  for (const Cell cell : ahead) EXPECT_GT(grid.centre_of(cell).x(), 0.0);
}

TEST(ClearedFootprint, OfAFootprintIsItsInscribedDisc) {
  RobotModel robot = round_robot(1.0);
  robot.polygon_m = {{-0.2, -0.1}, {0.6, -0.1}, {0.6, 0.1}, {-0.2, 0.1}};
  const OccupancyGrid grid(0.05);
  ClearedFootprint inside(robot);
  EXPECT_FALSE(inside.unknown_under(grid, {}).empty());
  for (const Cell cell : inside.unknown_under(grid, {})) EXPECT_LE(grid.centre_of(cell).norm(), 0.15 + 1e-9);
  robot.polygon_m = {{0.2, -0.1}, {0.6, -0.1}, {0.6, 0.1}};
  EXPECT_TRUE(ClearedFootprint(robot).unknown_under(grid, {}).empty()) << "its origin is outside";
}

TEST(ClearedFootprint, IsNothingBeyondTheGridAndOfNoRobot) {
  const OccupancyGrid grid(0.05);
  EXPECT_TRUE(ClearedFootprint(round_robot(0.2)).unknown_under(grid, {1e7, 0.0, 0.0}).empty());
  EXPECT_TRUE(ClearedFootprint().unknown_under(grid, {}).empty());
}

}  // namespace
}  // namespace cairn::sonar_model
