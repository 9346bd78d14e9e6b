#include "framework/experiments/map_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

// A room of 2 x 2 m; its walls run through the middle of cells of 0.1 m.
World room() {
  World world;
  world.max_m = {2.2, 2.2};
  world.walls = {{{{0.15, 0.15}, {2.05, 0.15}, {2.05, 2.05}, {0.15, 2.05}, {0.15, 0.15}}, Surface::smooth}};
  return world;
}

constexpr double kCell_m = 0.1;
const Point kMiddle(1.1, 1.1);

TrueCells seen_from_the_middle(const World& world) {
  TrueCells truth(world, kCell_m, {0.0, 0.0});
  truth.look_from(kMiddle, 3.0);
  return truth;
}

// Every wall cell at one log-odds, every free cell at another.
OccupancyGrid drawn(const TrueCells& truth, double wall_nat, double free_nat) {
  OccupancyGrid grid(kCell_m, 8.0);
  for (int y = 0; y < 22; ++y)
    for (int x = 0; x < 22; ++x)
      grid.set_log_odds({x, y}, static_cast<LogOdds>(kLogOddsPerNat * (truth.is_wall({x, y}) ? wall_nat : free_nat)));
  return grid;
}

TEST(MapQuality, WallsAreTheCellsThatTheirLinesRunThrough) {
  const TrueCells truth(room(), kCell_m, {0.0, 0.0});
  for (int i = 1; i < 20; ++i) {
    EXPECT_TRUE(truth.is_wall({i, 1}));
    EXPECT_TRUE(truth.is_wall({1, i}));
    EXPECT_TRUE(truth.is_wall({i, 20}));
    EXPECT_FALSE(truth.is_wall({i, 2}) && i > 1 && i < 20);
    EXPECT_FALSE(truth.is_wall({i, 0}));
  }
}

TEST(MapQuality, NothingBehindAWallIsSeen) {
  World world = room();
  world.walls.push_back({{{1.55, 0.15}, {1.55, 2.05}}, Surface::rough});
  const TrueCells truth = seen_from_the_middle(world);
  EXPECT_TRUE(truth.is_seen({15, 11})) << "the wall itself";
  EXPECT_TRUE(truth.is_seen({14, 11}));
  for (int y = 0; y < 22; ++y) EXPECT_FALSE(truth.is_seen({17, y}));
}

TEST(MapQuality, AnUnknownMapScoresAsGuessingDoes) {
  const MapQuality quality = seen_from_the_middle(room()).judge(OccupancyGrid(kCell_m));
  EXPECT_NEAR(quality.wall_log_loss, std::log(2.0), 1e-12);
  EXPECT_NEAR(quality.free_log_loss, std::log(2.0), 1e-12);
  EXPECT_NEAR(quality.brier, 0.25, 1e-12);
  EXPECT_EQ(quality.ghost_ratio, 0.0);
  EXPECT_EQ(quality.missed_ratio, 1.0);
  EXPECT_EQ(quality.free_cells, 18 * 18);
}

TEST(MapQuality, ATrueMapScoresNearNothingAndAFalseOneBadly) {
  const TrueCells truth = seen_from_the_middle(room());
  const MapQuality good = truth.judge(drawn(truth, 6.0, -6.0));
  EXPECT_NEAR(good.log_loss, std::log1p(std::exp(-6.0)), 1e-9);
  EXPECT_LT(good.brier, 1e-4);
  EXPECT_EQ(good.ghost_ratio, 0.0);
  EXPECT_EQ(good.missed_ratio, 0.0);
  const MapQuality bad = truth.judge(drawn(truth, -6.0, 6.0));
  EXPECT_NEAR(bad.log_loss, 6.0 + std::log1p(std::exp(-6.0)), 1e-9);
  EXPECT_EQ(bad.ghost_ratio, 1.0);
}

TEST(MapQuality, OneGhostCountsOnceAndNotBesideAWall) {
  const TrueCells truth = seen_from_the_middle(room());
  OccupancyGrid grid = drawn(truth, 6.0, -6.0);
  grid.set_log_odds({2, 10}, 1000);  // beside the wall: within its rounding
  EXPECT_EQ(truth.judge(grid).ghost_ratio, 0.0);
  grid.set_log_odds({10, 10}, 1000);
  EXPECT_NEAR(truth.judge(grid).ghost_ratio, 1.0 / (16 * 16), 1e-12);
}

TEST(MapQuality, ARoundThingIsDrawnAsItsOutline) {
  World world = room();
  world.objects.push_back({"", Contour::circle(0.6), {1.1, 1.1, 0.0}, Surface::rough});
  const TrueCells truth(world, kCell_m, {0.0, 0.0});
  EXPECT_TRUE(truth.is_wall({13, 10}) || truth.is_wall({14, 10}));
  EXPECT_FALSE(truth.is_wall({11, 11})) << "within";
}

}  // namespace
}  // namespace cairn
