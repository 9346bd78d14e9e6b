#include "plugins/behaviours/local_map/free_space.hpp"

#include <gtest/gtest.h>

#include "plugins/common/motion/path.hpp"
#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Cells of 0.1 m; the robot needs 0.2 + 0.1 m.
RobotSpace robot_at(const Point& p) {
  return {p, 0.2, 0.1};
}

FreeSpace space_of(const AsciiGrid& map, char start, const std::vector<TroubleSpot>& troubles = {}) {
  return FreeSpace(map.grid, robot_at(map.at(start)), {{map.at(start).x(), map.at(start).y(), 0.0}}, troubles);
}

const std::string kRooms = R"(
####################
#........#.........#
#........#.........#
#...R....#....B....#
#........#.........#
#..................#
#..................#
#........A.........#
#..................#
#..................#
#........#.........#
#........#.........#
####################
)";

TEST(FreeSpace, ReachesWhatHasEnoughRoomOnly) {
  const AsciiGrid map(R"(
####################
#........#.........#
#...R....#....B....#
#..................#
#........#.........#
#........#.........#
####################
)");
  EXPECT_FALSE(space_of(map, 'R').reaches(map.places.at('B')));  // a gap of 0.1 m
  const AsciiGrid wide(kRooms);
  EXPECT_TRUE(space_of(wide, 'R').reaches(wide.places.at('A')));
  EXPECT_TRUE(space_of(wide, 'R').reaches(wide.places.at('B')));
}

TEST(FreeSpace, PathsKeepTheClearanceAllAlong) {
  const AsciiGrid map(kRooms);
  const FreeSpace space = space_of(map, 'R');
  const std::vector<Point> path = space.path_to(map.places.at('B'));
  ASSERT_FALSE(path.empty());
  EXPECT_EQ(path.front(), map.at('R'));
  EXPECT_EQ(path.back(), map.at('B'));
  for (double s = 0.0; s <= length_of(path); s += 0.02)
    EXPECT_GE(space.distance_m(space.cell_at(motion::point_along(path, s))), 0.3 - 1e-6) << s;
  EXPECT_LT(path.size(), 10U);  // straightened
}

TEST(FreeSpace, NeverCrossesUnknownCells) {
  const AsciiGrid map(R"(
.............
......  .....
.R....  ...A.
......  .....
......  .....
)");
  EXPECT_FALSE(space_of(map, 'R').reaches({7, 2}));
  const FreeSpace space = space_of(map, 'R');
  const std::vector<Point> path = space.path_to(map.places.at('A'));
  for (double s = 0.0; s <= length_of(path); s += 0.02)
    EXPECT_EQ(space.state(space.cell_at(motion::point_along(path, s))), CellState::free);
}

TEST(FreeSpace, WhereTheRobotHasStoodIsFree) {
  const AsciiGrid map(R"(
..........
..........
....   ...
....   ...
....   ...
..........
..........
)");
  const Point under = map.grid.centre_of({5, 3});
  const FreeSpace space(map.grid, robot_at(under), {{under.x(), under.y(), 0.0}});
  EXPECT_EQ(space.state({5, 3}), CellState::free);
  EXPECT_TRUE(space.reaches({0, 0}));
}

TEST(FreeSpace, ARobotTooNearToAWallTakesTheWayOutFirst) {
  const AsciiGrid map(R"(
##########
#........#
#........#
#...A....#
#........#
#........#
#...R....#
##########
)");
  const FreeSpace space = space_of(map, 'R');
  EXPECT_EQ(space.escape_path().size(), 3U);
  EXPECT_TRUE(space.reaches(map.places.at('A')));
  const std::vector<Point> path = space.path_to(map.places.at('A'));
  EXPECT_EQ(path.front(), map.at('R'));
  EXPECT_NEAR(length_of(path), 0.3, 1e-6);
}

TEST(FreeSpace, ReachesNothingFromInsideAWall) {
  const AsciiGrid map(R"(
#####
##R##
#####
)");
  EXPECT_FALSE(space_of(map, 'R').reaches({0, 0}));
  EXPECT_TRUE(space_of(map, 'R').path_to({0, 0}).empty());
}

TEST(FreeSpace, GoesRoundATroubleSpotWhenThereIsAnotherWay) {
  const AsciiGrid map(R"(
....................
....................
....................
....................
.R........T.......A.
....................
....................
....................
....................
)");
  const FreeSpace space = space_of(map, 'R', {{map.at('T'), 100.0}});
  const std::vector<Point> path = space.path_to(map.places.at('A'));
  double nearest_m = 1e9;
  for (double s = 0.0; s <= length_of(path); s += 0.02)
    nearest_m = std::min(nearest_m, (motion::point_along(path, s) - map.at('T')).norm());
  EXPECT_GT(nearest_m, 0.25);
}

TEST(FreeSpace, SeesUpToTheFirstOccupiedCell) {
  const AsciiGrid map(R"(
..........
.R...#..#.
..........
)");
  const FreeSpace space = space_of(map, 'R');
  EXPECT_TRUE(space.sees(map.at('R'), {5, 1}));
  EXPECT_FALSE(space.sees(map.at('R'), {8, 1}));
}

TEST(PathIsBlocked, ByOccupiedCellsNearTheStretchAheadOnly) {
  const AsciiGrid map(R"(
..............
..............
.R....#.......
..............
)");
  const std::vector<Point> path{map.at('R'), map.at('R') + Point{1.2, 0.0}};
  EXPECT_TRUE(path_is_blocked(map.grid, path, 0.0, 0.6, 0.2));
  EXPECT_FALSE(path_is_blocked(map.grid, path, 0.0, 0.2, 0.2));  // too far ahead
  EXPECT_FALSE(path_is_blocked(map.grid, path, 0.8, 0.6, 0.2));  // passed
  EXPECT_FALSE(path_is_blocked(map.grid, {}, 0.0, 1.0, 0.2));
}

}  // namespace
}  // namespace cairn::behaviours
