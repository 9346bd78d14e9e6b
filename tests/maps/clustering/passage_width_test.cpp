#include "maps/clustering/passage_width.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

constexpr double kCell_m = 0.05;

// Free ground of 8 x 4 m, with a wall 0.15 m thick across it at x = 4 m and a door in the wall, from y = 2 m upwards.
OccupancyGrid two_rooms(double door_m) {
  OccupancyGrid grid(kCell_m);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 160; ++x) {
      const bool is_wall = x >= 80 && x < 83 && !(y >= 40 && y < 40 + std::lround(door_m / kCell_m));
      grid.set_log_odds({x, y}, log_odds_of(is_wall ? 0.95 : 0.05));
    }
  return grid;
}

double width_m(const OccupancyGrid& grid, const std::vector<Pose2>& trajectory,
               const std::vector<Point>& landmarks_m = {}) {
  return passage_width_m(trajectory, grid, landmarks_m, 2.0);
}

TEST(PassageWidth, OfADoorIsTheDoorsHoweverTheRouteLeadsThroughIt) {
  for (const double door_m : {0.8, 1.0, 1.2}) {
    const OccupancyGrid grid = two_rooms(door_m);
    EXPECT_NEAR(width_m(grid, {{2.0, 2.4, 0.0}, {6.0, 2.4, 0.0}}), door_m, 2.5 * kCell_m) << "straight";
    EXPECT_NEAR(width_m(grid, {{6.0, 2.4, 0.0}, {2.0, 2.4, 0.0}}), door_m, 2.5 * kCell_m) << "back";
    EXPECT_NEAR(width_m(grid, {{2.0, 0.4, 0.0}, {6.0, 4.0 - 0.4, 0.0}}), door_m, 0.3 * door_m) << "obliquely";
    EXPECT_NEAR(width_m(grid, {{3.5, 0.5, 0.0}, {4.0, 2.3, 0.0}, {4.2, 2.3, 0.0}, {4.6, 0.5, 0.0}}), door_m,
                0.3 * door_m)
        << "round the jambs";
  }
}

TEST(PassageWidth, BesideAWallIsThatOfTheRoom) {
  EXPECT_EQ(width_m(two_rooms(1.0), {{1.6, 0.35, 0.0}, {2.6, 0.35, 0.0}}), 2.0);
  EXPECT_EQ(width_m(two_rooms(1.0), {{1.0, 2.0, 0.0}, {3.0, 2.2, 0.0}}), 2.0);
}

TEST(PassageWidth, ALandmarkBesideAWallDividesNothing) {
  OccupancyGrid grid = two_rooms(1.0);
  for (int y = 12; y < 22; ++y)
    for (int x = 30; x < 40; ++x) grid.set_log_odds({x, y}, log_odds_of(0.95));
  const std::vector<Pose2> between{{1.0, 0.3, 0.0}, {2.6, 0.3, 0.0}};
  EXPECT_LT(width_m(grid, between), 0.8);
  EXPECT_GT(width_m(grid, between, {{1.75, 0.85}}), 1.8);
}

TEST(PassageWidth, OfACorridorIsTheCorridors) {
  OccupancyGrid grid(kCell_m);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 100; ++x) grid.set_log_odds({x, y}, log_odds_of(0.05));
  EXPECT_NEAR(width_m(grid, {{1.0, 0.4, 0.0}, {4.0, 0.6, 0.0}}), 1.6, 2.5 * kCell_m) << "what is unknown is a wall too";
}

TEST(PassageWidth, WithoutAWayIsTheLargest) {
  EXPECT_EQ(width_m(two_rooms(1.0), {}), 2.0);
  EXPECT_EQ(width_m(two_rooms(1.0), {{1.0, 1.0, 0.0}}), 2.0);
  EXPECT_EQ(width_m(two_rooms(1.0), {{1.0, 1.0, 0.0}, {1.0, 1.0, 0.0}}), 2.0);
}

}  // namespace
}  // namespace cairn
