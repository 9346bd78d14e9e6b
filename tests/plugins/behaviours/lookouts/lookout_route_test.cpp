#include "plugins/behaviours/lookouts/lookout_route.hpp"

#include <gtest/gtest.h>

#include "plugins/common/motion/path.hpp"
#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Two rooms, cells of 0.1 m; only the certainty of the map shows where the door in between is.
const std::string kRooms = R"(
#################################
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#..R............#............G..#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#...............#...............#
#################################
)";
constexpr double kStandOff_m = 0.5;

struct Rooms : AsciiGrid {
  Rooms() : AsciiGrid(kRooms) {
    for (int y = 1; y <= 6; ++y) grid.set_log_odds({16, y}, 200);  // seen closed a few times only
  }
  [[nodiscard]] std::optional<LookoutRoute> way(const std::vector<Point>& looked_at = {}) const {
    const Pose2 robot{at('R').x(), at('R').y(), 0.0};
    const FreeSpace space(grid, {robot.position(), 0.2, 0.03}, {robot});
    return lookout_route(space, grid, robot.position(), at('G'), looked_at, kStandOff_m);
  }
};

TEST(LookoutRoute, IsWhereTheMapIsLeastSure) {
  const std::optional<LookoutRoute> way = Rooms().way();
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->at.x(), 1.65, 0.11);
  EXPECT_LT(way->at.y(), 0.75) << "the door";
  EXPECT_GE((way->path.back() - way->at).norm(), kStandOff_m);
  EXPECT_LT((way->path.back() - way->at).norm(), kStandOff_m + 0.4);
}

TEST(LookoutRoute, WhatHasBeenLookedAtComesLast) {
  const Rooms rooms;
  const Point first = rooms.way()->at;
  const std::optional<LookoutRoute> next = rooms.way({first});
  ASSERT_TRUE(next);
  EXPECT_GT((next->at - first).norm(), 0.4);
}

TEST(LookoutRoute, AGoalOffTheMapIsLookedForToo) {
  const Rooms rooms;
  const Pose2 robot{rooms.at('R').x(), rooms.at('R').y(), 0.0};
  const FreeSpace space(rooms.grid, {robot.position(), 0.2, 0.03}, {robot});
  const std::optional<LookoutRoute> way =
      lookout_route(space, rooms.grid, robot.position(), {9.0, 0.4}, {}, kStandOff_m);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->at.x(), 1.65, 0.11);
}

TEST(LookoutRoute, IsNoneWhereNothingStandsInTheWay) {
  Rooms rooms;
  for (int y = 1; y <= 14; ++y) rooms.grid.set_log_odds({16, y}, -600);
  EXPECT_FALSE(rooms.way());
}

}  // namespace
}  // namespace cairn::behaviours
