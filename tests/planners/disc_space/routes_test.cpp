#include "planners/disc_space/routes.hpp"

#include <gtest/gtest.h>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;

const char* const kTwoRooms =
    "#################\n"
    "#.......#.......#\n"
    "#.......#.......#\n"
    "#.A.....#.....B.#\n"
    "#.......#.......#\n"
    "#.......#.......#\n"
    "#...............#\n"
    "#...............#\n"
    "#...............#\n"
    "#################\n";

TEST(Routes, OverTheCellsRoundAWall) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const Point from = world.places.at('A');
  const Point to = world.places.at('B');
  const std::vector<Point> route = route_over_cells(space, from, to, 0.1);
  ASSERT_GE(route.size(), 3U);
  EXPECT_EQ(route.front(), from);
  EXPECT_EQ(route.back(), to);
  EXPECT_TRUE(route_is_free(world.grid, {}, route, 0.1)) << test::drawing_of(world.grid, poses_along(route, 0, {}));
  EXPECT_LT(length_of(route), 1.9);
  EXPECT_TRUE(route_over_cells(space, from, to, 0.16).empty()) << "a disc 0.32 m wide, a gap of 0.30 m";
}

TEST(Routes, ADiscJustNarrowerThanTheGapPasses) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const std::vector<Point> route = route_over_cells(space, world.places.at('A'), world.places.at('B'), 0.149);
  EXPECT_TRUE(route_is_free(world.grid, {}, route, 0.149));
}

TEST(Routes, TheRecheckKnowsTheEscapeAndNothingElse) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const Point start(0.15, 0.55);
  const auto escape = escape_from(world.grid, space, start, 0.12, 0.2);
  ASSERT_TRUE(escape);
  const std::vector<Point> route{start, escape->to, {0.5, 0.55}};
  EXPECT_TRUE(route_is_free(world.grid, {}, route, 0.12, escape));
  EXPECT_FALSE(route_is_free(world.grid, {}, route, 0.12)) << "without the escape";
  EXPECT_FALSE(route_is_free(world.grid, {}, {start, {0.5, 0.55}}, 0.12, escape)) << "another first segment";
  EXPECT_FALSE(route_is_free(world.grid, {}, {}, 0.12));
}

TEST(Routes, StraightenedKeepsTheEndsAndTheFirstPointsAskedFor) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const std::vector<Point> route{{0.25, 0.25}, {0.35, 0.35}, {0.45, 0.25}, {0.65, 0.25}};
  EXPECT_EQ(straightened(space, route, 0.1), (std::vector<Point>{route.front(), route.back()}));
  EXPECT_EQ(straightened(space, route, 0.1, 2), (std::vector<Point>{route[0], route[1], route[3]}));
}

TEST(Routes, PosesLookAlongTheRouteAndEndAsTheGoalAsks) {
  const std::vector<Pose2> poses = poses_along({{0, 0}, {1, 0}, {1, 2}}, 3.0, radians(45.0));
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_DOUBLE_EQ(poses[0].theta_rad, 0.0);
  EXPECT_DOUBLE_EQ(poses[1].theta_rad, radians(90.0));
  EXPECT_DOUBLE_EQ(poses[2].theta_rad, radians(45.0));
  EXPECT_DOUBLE_EQ(poses_along({{0, 0}, {1, 0}}, 3.0, {}).back().theta_rad, 0.0);
  EXPECT_DOUBLE_EQ(poses_along({{0, 0}}, 3.0, {}).back().theta_rad, 3.0);
}

TEST(Routes, ClearanceIsTheDiscsEdgeToTheNearestWall) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  EXPECT_NEAR(clearance_along(space, {{0.25, 0.25}, {1.2, 0.25}}, 0.1), 0.05, 1e-3);
  EXPECT_EQ(clearance_along(space, {{0.15, 0.25}}, 0.1), 0.0);
}

}  // namespace
}  // namespace cairn
