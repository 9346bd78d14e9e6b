#include "plugins/behaviours/lookouts/openings.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Cells of 0.1 m and a robot that needs 0.3 m to both sides: the opening of 0.3 m is too narrow.
const std::string kNarrow = R"(
#################################
#..........#....................#
#..........#....................#
#..........#....................#
#..........#....................#
#...............................#
#..R............................#
#...............................#
#..........#....................#
#..........#....................#
#..........#....................#
#..........#....................#
#################################
)";

std::optional<Opening> opening_of(const AsciiGrid& map, const std::vector<Point>& seen = {}) {
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.1}, {robot});
  const FreeSpace narrow(map.grid, {robot.position(), 0.2, -0.08}, {robot});
  return nearest_opening(space, narrow, seen);
}

TEST(NearestOpening, IsWhereTheWayToARoomGetsTooNarrow) {
  const AsciiGrid map(kNarrow);
  const std::optional<Opening> opening = opening_of(map);
  ASSERT_TRUE(opening);
  EXPECT_NEAR(opening->at_m.x(), 1.0, 0.25);
  EXPECT_NEAR(opening->at_m.y(), 0.65, 0.2);
  EXPECT_LT(map.grid.centre_of(opening->lookout).x(), 1.1);
}

TEST(NearestOpening, IsNoneOnceItHasBeenLookedAt) {
  const AsciiGrid map(kNarrow);
  EXPECT_FALSE(opening_of(map, {opening_of(map)->at_m}));
}

TEST(NearestOpening, IsNoneWithoutRoomBehind) {
  EXPECT_FALSE(opening_of(AsciiGrid(R"(
##################
#..........#.....#
#..........#.....#
#..........#.....#
#..........#.....#
#................#
#..R.............#
#................#
#..........#.....#
#..........#.....#
#..........#.....#
##################
)")));
}

TEST(NearestOpening, IsNoneWhereTheRobotFitsThrough) {
  std::string drawing = kNarrow;
  for (std::size_t at; (at = drawing.find(".#.")) != std::string::npos;) drawing[at + 1] = '.';
  EXPECT_FALSE(opening_of(AsciiGrid(drawing)));
}

// Of an opening of 0.3 m, for a robot of 0.2 m.
bool leads_on(const AsciiGrid& map, double clearance_m) {
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.1}, {robot});
  return tighter_leads_on(space, FreeSpace(map.grid, {robot.position(), 0.2, clearance_m}, {robot}));
}

TEST(TighterLeadsOn, WhereItGetsToARoom) {
  EXPECT_TRUE(leads_on(AsciiGrid(kNarrow), -0.08));
  EXPECT_FALSE(leads_on(AsciiGrid(kNarrow), 0.05)) << "not through";
  EXPECT_FALSE(leads_on(AsciiGrid(kNarrow), 0.1)) << "no tighter";
}

TEST(TighterLeadsOn, NotForTheRimOfItsOwnRoom) {
  EXPECT_FALSE(leads_on(AsciiGrid(R"(
############
#..........#
#..........#
#..........#
#..........#
#..R.......#
#..........#
#..........#
#..........#
############
)"),
                        -0.08));
}

// A room of 2 x 0.9 m in reach; one of 1.5 m and one of 0.9 m are shut, the last with 0.3 m for the robot's centre.
const std::string kShut = R"(
################################################
#....................#...............#.........#
#....................#...............#.........#
#....................#...............#.........#
#....................#...............#.........#
#....................#...............#.........#
#..R.................#...............#.........#
#....................#...............#.........#
#....................#...............#.........#
#....................#...............#.........#
################################################
)";

std::optional<Point> room_of(const AsciiGrid& map, const std::vector<Point>& tried = {}) {
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  return room_out_of_reach(FreeSpace(map.grid, {robot.position(), 0.2, 0.1}, {robot}), robot.position(), tried);
}

TEST(RoomOutOfReach, IsTheLargestThatIsShut) {
  const std::optional<Point> place = room_of(AsciiGrid(kShut));
  ASSERT_TRUE(place);
  EXPECT_GT(place->x(), 2.3);
  EXPECT_LT(place->x(), 3.5);
  EXPECT_NEAR(place->y(), 0.55, 0.25) << "well inside";
}

TEST(RoomOutOfReach, IsNoneOnceItHasBeenTried) {
  const AsciiGrid map(kShut);
  EXPECT_FALSE(room_of(map, {*room_of(map)})) << "what is left is too small";
}

TEST(RoomOutOfReach, IsNoneWhereAllIsInReach) {
  std::string open = kShut;
  for (const std::size_t row : {4U, 5U, 6U, 7U, 8U}) open[1 + 49 * row + 21] = '.';
  EXPECT_FALSE(room_of(AsciiGrid(open)));
}

}  // namespace
}  // namespace cairn::behaviours
