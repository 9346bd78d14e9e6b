#include "planners/common/disc_space/disc_space.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planners/common/disc_space/space_cache.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;

// Random clutter of occupied and unknown cells, away from the origin.
OccupancyGrid random_grid(std::mt19937_64& random, int side) {
  OccupancyGrid grid(0.05, 4.0, {-3.17, 2.71});
  std::uniform_int_distribution<int> percent(0, 99);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int draw = percent(random);
      grid.set_log_odds({x - 5, y + 9}, draw < 3 ? LogOdds{900} : draw < 5 ? LogOdds{0} : LogOdds{-900});
    }
  return grid;
}

Point random_point(std::mt19937_64& random, const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  std::uniform_real_distribution<double> x(box.min.x, box.max.x);
  std::uniform_real_distribution<double> y(box.min.y, box.max.y);
  return grid.origin_m() + grid.cell_m() * Point(x(random), y(random));
}

TEST(DiscSpace, AnswersLikeTheCellByCellCheckWhateverTheGrid) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> radius(0.0, 0.25);
  int free = 0;
  for (const UnknownPolicy unknown : {UnknownPolicy::avoid, UnknownPolicy::allow}) {
    GroundRules rules;
    rules.unknown = unknown;
    for (int trial = 0; trial < 20; ++trial) {
      const OccupancyGrid grid = random_grid(random, 40);
      const DiscSpace space(grid, rules);
      for (int k = 0; k < 200; ++k) {
        const Point from = random_point(random, grid);
        const Point to = k % 4 == 0 ? from : random_point(random, grid);
        const double radius_m = k % 5 == 0 ? 0.0 : radius(random);
        const bool fits = space.fits_along(from, to, radius_m);
        EXPECT_EQ(fits, sweep_is_free(grid, rules, from, to, radius_m)) << "radius " << radius_m;
        free += fits;
      }
    }
  }
  EXPECT_GT(free, 500) << "the clutter is too dense for the test to mean anything";
}

TEST(DiscSpace, AnswersLikeTheCellByCellCheckOverLongStretchesOfOpenGround) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> radius(0.0, 0.5);
  int free = 0;
  for (int trial = 0; trial < 6; ++trial) {
    OccupancyGrid grid(0.05, 4.0, {1.23, -4.56});
    std::bernoulli_distribution is_occupied(0.0008);
    for (int y = 0; y < 150; ++y)
      for (int x = 0; x < 190; ++x) grid.set_log_odds({x, y}, is_occupied(random) ? LogOdds{900} : LogOdds{-900});
    const DiscSpace space(grid, {});
    for (int k = 0; k < 500; ++k) {
      const Point from = random_point(random, grid);
      const Point to = random_point(random, grid);
      const double radius_m = radius(random);
      const bool fits = space.fits_along(from, to, radius_m);
      EXPECT_EQ(fits, sweep_is_free(grid, {}, from, to, radius_m)) << "radius " << radius_m;
      free += fits;
    }
  }
  EXPECT_GT(free, 300);
  EXPECT_LT(free, 2700);
}

TEST(DiscSpace, WhereNothingIsBlockedAnyDiscFits) {
  const auto world = drawn_world("...\n...\n");
  GroundRules rules;
  rules.unknown = UnknownPolicy::allow;
  EXPECT_TRUE(DiscSpace(world.grid, rules).fits_along({0.05, 0.05}, {0.25, 0.15}, 5.0));
}

TEST(DiscSpace, NothingFitsOutsideTheMapOrAtNumbersThatAreNotFinite) {
  const auto world = drawn_world(".....\n.....\n.....\n");
  const DiscSpace space(world.grid, {});
  EXPECT_TRUE(space.fits({0.25, 0.15}, 0.1));
  EXPECT_FALSE(space.fits({0.25, 0.15}, 0.2)) << "the edge of the known map counts";
  EXPECT_FALSE(space.fits({1e12, -1e12}, 0.0));
  EXPECT_FALSE(space.fits({NAN, 0.1}, 0.0));
  EXPECT_FALSE(space.fits_along({0.25, 0.15}, {0.25, INFINITY}, 0.0));
}

TEST(DiscSpace, AThinWallIsNeverCut) {
  const auto world = drawn_world(
      "...........#...........\n"
      "...........#...........\n"
      "...........#...........\n",
      0.05);
  const DiscSpace space(world.grid, {});
  for (double y = 0.01; y < 0.15; y += 0.01) {
    EXPECT_FALSE(space.fits_along({0.05, y}, {1.1, 0.15 - y}, 0.0));
    EXPECT_FALSE(space.fits_along({0.05, y}, {1.1, 0.15 - y}, 0.001));
  }
}

TEST(DiscSpace, TheShareThatFitsEndsAtTheObstacle) {
  const auto world = drawn_world(
      "..........\n"
      "........#.\n"
      "..........\n");
  const DiscSpace space(world.grid, {});
  const Point from(0.15, 0.15);
  const Point to(0.75, 0.15);
  EXPECT_NEAR(space.share_that_fits(from, to, 0.05) * (to - from).norm(), 0.80 - 0.05 - 0.15, 0.002);
  EXPECT_EQ(space.share_that_fits({0.85, 0.15}, to, 0.05), 0.0) << "begins on the obstacle";
}

TEST(DiscSpace, DistanceOfASegmentIsThatOfBruteForce) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const OccupancyGrid grid = random_grid(random, 24);
    const Pose2 from{random_point(random, grid).x(), random_point(random, grid).y(), 0.0};
    const Pose2 to{random_point(random, grid).x(), random_point(random, grid).y(), 0.0};
    const double expected_m = test::distance_by_brute_force(grid, {from, to}, false, 0.001);
    EXPECT_NEAR(DiscSpace(grid, {}).distance_m(from.position(), to.position()), expected_m, 0.002);
  }
}

TEST(DiscSpace, WhatTravelDoesNotReachNoChainOfFreeSegmentsReaches) {
  std::mt19937_64 random(5);
  for (const double radius_m : {0.0, 0.04, 0.1, 0.17}) {
    for (int trial = 0; trial < 10; ++trial) {
      const OccupancyGrid grid = random_grid(random, 40);
      const DiscSpace space(grid, {});
      Point at = random_point(random, grid);
      if (!space.fits(at, radius_m)) continue;
      const TravelField travel = space.travel_at_most(at, radius_m);
      for (int k = 0; k < 300; ++k) {
        const Point next = random_point(random, grid);
        if (!space.fits_along(at, next, radius_m)) continue;
        EXPECT_TRUE(travel.reaches(space.field().cell_at(next))) << "radius " << radius_m;
        at = next;
      }
    }
  }
}

TEST(SpaceCache, AnswersForTheGridAsItIsNow) {
  auto world = drawn_world("..A..\n.....\n");
  const SpaceCache cache;
  const auto before = cache.space_of(world.grid, {});
  EXPECT_EQ(before, cache.space_of(OccupancyGrid(world.grid), {})) << "an equal grid";
  EXPECT_TRUE(before->fits(world.places['A'], 0.0));
  world.fill('A', CellState::occupied);
  EXPECT_FALSE(cache.space_of(world.grid, {})->fits(world.places['A'], 0.0));
  EXPECT_TRUE(before->fits(world.places['A'], 0.0)) << "what was handed out stays as it was";
}

TEST(SpaceCache, KeepsWhatItHasWhileTheCellsAreTheSame) {
  const auto world = test::drawn_world(".....\n..#..\n.....\n");
  const SpaceCache cache;
  const auto first = cache.space_of(world.grid, {}, 1);
  EXPECT_EQ(cache.space_of(world.grid, {}, 1), first);
  EXPECT_EQ(cache.space_of(world.grid, {}, 2), first) << "a version of the same cells";
  EXPECT_EQ(cache.space_of(world.grid, {}), first);
  const auto larger = test::drawn_world(".....\n..#..\n.....\n", 0.2);
  EXPECT_EQ(cache.space_of(larger.grid, {})->cell_m(), 0.2) << "the same cells on another lattice";
}

}  // namespace
}  // namespace cairn
