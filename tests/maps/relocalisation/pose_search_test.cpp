#include "maps/relocalisation/pose_search.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

// Writes a wall of occupied cells into a grid.
void wall(OccupancyGrid& grid, const Point& from_m, const Point& to_m) {
  const int steps = static_cast<int>((to_m - from_m).norm() / (0.5 * grid.cell_m())) + 1;
  for (int i = 0; i <= steps; ++i)
    grid.set_log_odds(grid.cell_at(from_m + (to_m - from_m) * (static_cast<double>(i) / steps)), LogOdds{1000});
}

void rectangle(OccupancyGrid& grid, const Point& low_m, const Point& high_m) {
  wall(grid, low_m, {high_m.x(), low_m.y()});
  wall(grid, {high_m.x(), low_m.y()}, high_m);
  wall(grid, high_m, {low_m.x(), high_m.y()});
  wall(grid, {low_m.x(), high_m.y()}, low_m);
}

OccupancyGrid free_area(double width_m, double height_m) {
  OccupancyGrid grid(0.05);
  for (double y_m = 0.025; y_m < height_m; y_m += 0.05)
    for (double x_m = 0.025; x_m < width_m; x_m += 0.05) grid.set_log_odds(grid.cell_at({x_m, y_m}), LogOdds{-1000});
  return grid;
}

// Two rooms of one size side by side; a cupboard stands in the second one only.
OccupancyGrid two_rooms(bool has_cupboard) {
  OccupancyGrid map = free_area(12.2, 5.2);
  rectangle(map, {0.1, 0.1}, {6.0, 5.0});
  rectangle(map, {6.0, 0.1}, {11.9, 5.0});
  wall(map, {1.0, 3.5}, {2.4, 3.5});
  wall(map, {6.9, 3.5}, {8.3, 3.5});
  if (has_cupboard) rectangle(map, {10.0, 1.0}, {11.0, 1.6});
  return map;
}

// What a robot draws that sees so far, with its own frame: the map's cells around it, by their middles.
OccupancyGrid seen_in(const OccupancyGrid& map, const Pose2& T_map_local, const CellBox& cells) {
  OccupancyGrid seen(0.05);
  const Pose2 T_local_map = inverse(T_map_local);
  for (int y = cells.min.y; y < cells.max.y; ++y)
    for (int x = cells.min.x; x < cells.max.x; ++x) {
      const LogOdds value = map.log_odds({x, y});
      const Cell at = seen.cell_at(T_local_map * map.centre_of({x, y}));
      if (value > 0 || seen.log_odds(at) <= 0) seen.set_log_odds(at, value);
    }
  return seen;
}

CellBox right_room(const OccupancyGrid& map) {
  return {map.cell_at({6.2, 0.0}), map.cell_at({12.0, 5.1})};
}

TEST(PoseSearch, FindsTheRobotInTheWholeMapWhateverItsFrame) {
  const OccupancyGrid map = two_rooms(true);
  const Pose2 T_map_local{9.0, 2.5, 2.0};
  const Pose2 T_local_robot{0.4, -0.3, 0.7};
  const Pose2 T_map_robot = T_map_local * T_local_robot;
  const Surroundings around = surroundings_of(seen_in(map, T_map_local, right_room(map)), T_local_robot);
  const std::vector<PoseHypothesis> found = PoseSearch(map).find(around);
  ASSERT_FALSE(found.empty());
  EXPECT_LT((found[0].T_map_robot.position() - T_map_robot.position()).norm(), 0.08);
  EXPECT_LT(std::abs(wrap_angle(found[0].T_map_robot.theta_rad - T_map_robot.theta_rad)), radians(2.0));
  EXPECT_TRUE(found[0].is_held_by_corners);
  EXPECT_GT(found[0].score, 0.7);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LT(found[i].score, found[0].score);
}

TEST(PoseSearch, TwoLikeRoomsAreTwoGuessesOfAboutOneScore) {
  const OccupancyGrid map = two_rooms(false);
  const Surroundings around = surroundings_of(seen_in(map, {9.0, 2.5, 0.0}, right_room(map)), {});
  const std::vector<PoseHypothesis> found = PoseSearch(map).find(around, KnownHeading{0.0, radians(20.0)});
  ASSERT_GE(found.size(), 2U);
  EXPECT_GT(found[1].score, 0.93 * found[0].score) << "nothing tells the two rooms apart";
  EXPECT_NEAR(std::abs(found[0].T_map_robot.x_m - found[1].T_map_robot.x_m), 5.9, 0.15);
}

TEST(PoseSearch, WhatStandsInTheOpenOfTheMapContradictsAGuess) {
  const OccupancyGrid map = two_rooms(true);
  const Surroundings around = surroundings_of(seen_in(map, {9.0, 2.5, 0.0}, right_room(map)), {});
  const std::vector<PoseHypothesis> found = PoseSearch(map).find(around, KnownHeading{0.0, radians(20.0)});
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found[0].contradicted_ratio, 0.02);
  const std::vector<PoseHypothesis> elsewhere =
      PoseSearch(two_rooms(false)).find(around, KnownHeading{0.0, radians(20.0)});
  ASSERT_FALSE(elsewhere.empty());
  EXPECT_GT(elsewhere[0].contradicted_ratio, 0.03) << "a cupboard is not in this map";
}

TEST(PoseSearch, AKnownHeadingLeavesOutPosesThatAreTurned) {
  OccupancyGrid map = free_area(6.2, 6.2);
  rectangle(map, {0.1, 0.1}, {6.0, 6.0});
  const Surroundings around = surroundings_of(seen_in(map, {3.0, 2.0, 0.0}, map.bounds()), {});
  const PoseSearch search(map);
  EXPECT_GE(search.find(around).size(), 4U) << "a square looks alike from four sides";
  const std::vector<PoseHypothesis> found = search.find(around, KnownHeading{0.0, radians(20.0)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].T_map_robot.position() - Point(3.0, 2.0)).norm(), 0.08);
}

TEST(PoseSearch, BareWallsOfACorridorHoldNoPoseAlongThem) {
  OccupancyGrid map = free_area(20.0, 2.2);
  wall(map, {0.0, 0.1}, {20.0, 0.1});
  wall(map, {0.0, 2.0}, {20.0, 2.0});
  const CellBox piece{map.cell_at({6.0, 0.0}), map.cell_at({11.0, 2.1})};
  const std::vector<PoseHypothesis> found =
      PoseSearch(map).find(surroundings_of(seen_in(map, {8.0, 1.0, 0.0}, piece), {}));
  ASSERT_FALSE(found.empty());
  for (const PoseHypothesis& guess : found) EXPECT_FALSE(guess.is_held_by_corners);
}

TEST(PoseSearch, ABelievedPoseIsScoredThereOrJustBeside) {
  const OccupancyGrid map = two_rooms(true);
  const Pose2 T_map_robot{9.0, 2.5, 0.0};
  const Surroundings around = surroundings_of(seen_in(map, T_map_robot, right_room(map)), {});
  const PoseSearch search(map);
  const PoseHypothesis right = search.at(around, T_map_robot);
  EXPECT_GT(right.score, 0.7);
  EXPECT_LT(right.contradicted_ratio, 0.02);
  const PoseHypothesis drifted = search.at(around, {9.3, 2.2, radians(7.0)});
  EXPECT_NEAR(drifted.score, right.score, 0.02);
  EXPECT_LT((drifted.T_map_robot.position() - T_map_robot.position()).norm(), 0.08);
  const PoseHypothesis carried = search.at(around, {7.5, 3.5, radians(40.0)});
  EXPECT_LT(carried.score, 0.8 * right.score);
  EXPECT_GT(carried.contradicted_ratio, 0.1);
}

TEST(PoseSearch, NothingThatWasSeenSaysNothingOfABelievedPose) {
  const PoseHypothesis nothing = PoseSearch(two_rooms(true)).at({}, {1.0, 2.0, 0.3});
  EXPECT_EQ(nothing.score, 0.0);
  EXPECT_EQ(nothing.contradicted_ratio, 0.0);
  EXPECT_EQ(nothing.T_map_robot.x_m, 1.0);
  const PoseHypothesis nowhere = PoseSearch(OccupancyGrid(0.05)).at({{{1.0, 0.0}}, {{0.0, 0.0}}}, {});
  EXPECT_EQ(nowhere.score, 0.0);
}

TEST(PoseSearch, NothingSeenOrAnEmptyMapGivesNoGuess) {
  EXPECT_TRUE(PoseSearch(two_rooms(true)).find({}).empty());
  EXPECT_TRUE(PoseSearch(OccupancyGrid(0.05)).find({{{1.0, 0.0}}, {{0.0, 0.0}}}).empty());
}

}  // namespace
}  // namespace cairn
