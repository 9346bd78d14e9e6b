#include "planners/common/disc_space/places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;
using ::testing::HasSubstr;

const char* const kRoom =
    "##########\n"
    "#........#\n"
    "#.A......#\n"
    "#........#\n"
    "#........#\n"
    "#B.....?.#\n"
    "#........#\n"
    "##########\n";

TEST(Places, TheNearestFitIsTheNearestAndTiesGoDownAndLeft) {
  const auto world = drawn_world("...\n.A.\n...\n");
  const DiscSpace space(world.grid, {});
  const auto accept_ring = [&](const Point& p) { return world.grid.cell_at(p) != Cell{1, 1}; };
  EXPECT_EQ(nearest_fit(space, world.places.at('A'), 0.0, 1.0), world.grid.centre_of({1, 1}));
  EXPECT_EQ(nearest_fit(space, world.places.at('A'), 0.0, 1.0, accept_ring), world.grid.centre_of({1, 0}));
  EXPECT_EQ(nearest_fit(space, world.places.at('A'), 0.3, 1.0), std::nullopt);
}

TEST(Places, WhyBlockedNamesWhatBlocks) {
  const auto world = drawn_world(kRoom);
  const DiscSpace space(world.grid, {});
  const double radius_m = 0.2;
  EXPECT_THAT(why_blocked(world.grid, space, {0.05, 0.05}, radius_m), HasSubstr("occupied cell"));
  EXPECT_EQ(why_blocked(world.grid, space, world.places.at('B'), radius_m),
            "an occupied cell is 0.05 m from its centre, and the robot needs 0.20 m");
  EXPECT_EQ(why_blocked(world.grid, space, {0.75, 0.25}, radius_m), "it lies in unknown space");
  EXPECT_EQ(why_blocked(world.grid, space, {0.55, 0.35}, radius_m),
            "unknown space is 0.16 m from its centre, and the robot needs 0.20 m");
  EXPECT_EQ(why_blocked(world.grid, space, {7.0, 7.0}, radius_m), "it lies outside the map");
}

TEST(Places, UnknownGroundThatMayBeCrossedBlocksNothing) {
  const auto world = drawn_world(kRoom);
  GroundRules rules;
  rules.unknown = UnknownPolicy::allow;
  const DiscSpace space(world.grid, rules);
  // In unknown ground, and further from it than from the wall.
  EXPECT_EQ(why_blocked(world.grid, space, {0.75, 0.25}, 0.2),
            "an occupied cell is 0.15 m from its centre, and the robot needs 0.20 m");
}

TEST(Places, ATightStartIsLeftForTheNearestFreePlace) {
  const auto world = drawn_world(kRoom);
  const DiscSpace space(world.grid, {});
  const Point start = world.places.at('B');  // 0.05 m from the wall
  const auto escape = escape_from(world.grid, space, start, 0.12, 0.15);
  ASSERT_TRUE(escape);
  EXPECT_TRUE(space.fits(escape->to, 0.12));
  EXPECT_NEAR(escape->keep_m, 0.05, 1e-5) << "never nearer to the wall than it was";
  EXPECT_TRUE(escape_is_free(world.grid, {}, start, *escape));
  EXPECT_FALSE(escape_from(world.grid, space, start, 0.3, 0.15)) << "nothing free within the tolerance";
  EXPECT_FALSE(escape_from(world.grid, space, {0.05, 0.35}, 0.1, 0.5)) << "the start is on an occupied cell";
}

TEST(Places, AnEscapeDoesNotLeadThroughAWall) {
  const auto world = drawn_world(
      "#########\n"
      "#...#...#\n"
      "#..S#...#\n"
      "#...#...#\n"
      "####....#\n"
      "#########\n");
  const DiscSpace space(world.grid, {});
  const auto escape = escape_from(world.grid, space, world.places.at('S'), 0.1, 0.3);
  ASSERT_TRUE(escape);
  EXPECT_LT(escape->to.x(), world.places.at('S').x());
}

TEST(Places, TheGroundUnderTheRobotIsKnownOnlyUnderTheRobot) {
  const auto world = drawn_world("?????\n?????\n??A??\n?????\n?????\n");
  const auto patched = with_ground_under(world.grid, {}, world.places.at('A'), 0.1);
  ASSERT_TRUE(patched);
  EXPECT_EQ(patched->state({2, 2}), CellState::free);
  EXPECT_EQ(patched->state({3, 2}), CellState::free);
  EXPECT_EQ(patched->state({4, 2}), CellState::unknown);
  EXPECT_EQ(world.grid.state({3, 2}), CellState::unknown);
  EXPECT_TRUE(DiscSpace(*patched, {}).fits(world.places.at('A'), 0.1));
}

TEST(Places, OneStandsAtALandmarksAccessOrNearItOrNearTheLandmark) {
  const auto world = drawn_world(kRoom);
  const DiscSpace space(world.grid, {});
  Landmark landmark;
  landmark.T_map_landmark = {0.05, 0.55, 0.0};  // in the wall
  const auto near = approach_pose(space, landmark, 0.1);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->x_m, 0.25, 1e-9);
  EXPECT_NEAR(std::abs(near->theta_rad), radians(180.0), 0.01) << "looks at the landmark";
  landmark.access = Pose2{0.5, 0.5, 1.0};
  EXPECT_EQ(approach_pose(space, landmark, 0.1), landmark.access);
  landmark.access = Pose2{0.75, 0.25, 1.0};  // unknown today
  const auto beside = approach_pose(space, landmark, 0.1);
  ASSERT_TRUE(beside);
  EXPECT_LT((beside->position() - landmark.access->position()).norm(), 0.3);
  EXPECT_FALSE(approach_pose(space, landmark, 0.5));
}

}  // namespace
}  // namespace cairn
