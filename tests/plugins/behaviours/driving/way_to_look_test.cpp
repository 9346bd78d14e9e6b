#include "plugins/behaviours/driving/way_to_look.hpp"

#include <gtest/gtest.h>

#include "plugins/behaviours/driving/path_follower.hpp"
#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Two rooms, cells of 0.1 m; nothing tells where the door in between is but how sure the map is.
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
  [[nodiscard]] std::optional<WayToLook> way(const std::vector<Point>& looked_at = {}) const {
    const Pose2 robot{at('R').x(), at('R').y(), 0.0};
    const FreeSpace space(grid, {robot.position(), 0.2, 0.03}, {robot});
    return way_to_look(space, grid, robot.position(), at('G'), looked_at, kStandOff_m);
  }
};

TEST(WayToLook, IsWhereTheMapIsLeastSure) {
  const std::optional<WayToLook> way = Rooms().way();
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->at.x(), 1.65, 0.11);
  EXPECT_LT(way->at.y(), 0.75) << "the door";
  EXPECT_GE((way->path.back() - way->at).norm(), kStandOff_m);
  EXPECT_LT((way->path.back() - way->at).norm(), kStandOff_m + 0.4);
}

TEST(WayToLook, WhatHasBeenLookedAtComesLast) {
  const Rooms rooms;
  const Point first = rooms.way()->at;
  const std::optional<WayToLook> next = rooms.way({first});
  ASSERT_TRUE(next);
  EXPECT_GT((next->at - first).norm(), 0.4);
}

TEST(WayToLook, AGoalOffTheMapIsLookedForToo) {
  const Rooms rooms;
  const Pose2 robot{rooms.at('R').x(), rooms.at('R').y(), 0.0};
  const FreeSpace space(rooms.grid, {robot.position(), 0.2, 0.03}, {robot});
  const std::optional<WayToLook> way = way_to_look(space, rooms.grid, robot.position(), {9.0, 0.4}, {}, kStandOff_m);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->at.x(), 1.65, 0.11);
}

TEST(WayToLook, IsNoneWhereNothingStandsInTheWay) {
  Rooms rooms;
  for (int y = 1; y <= 14; ++y) rooms.grid.set_log_odds({16, y}, -600);
  EXPECT_FALSE(rooms.way());
}

}  // namespace
}  // namespace cairn::behaviours
