#include "maps/grid/swept_disc.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;

TEST(SweptDisc, DistanceToASquareIsThatOfItsNearestPoint) {
  const Point centre(1.0, 1.0);
  EXPECT_DOUBLE_EQ(distance_to_square_m({2.0, 1.0}, {2.0, 1.0}, centre, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_square_m({2.0, 2.0}, {3.0, 3.0}, centre, 1.0), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(distance_to_square_m({0.0, 2.0}, {2.0, 2.0}, centre, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_square_m({-5.0, 1.0}, {5.0, 1.2}, centre, 1.0), 0.0) << "through";
  EXPECT_DOUBLE_EQ(distance_to_square_m({1.0, 1.0}, {1.1, 1.0}, centre, 1.0), 0.0) << "inside";
  EXPECT_NEAR(distance_to_square_m({1.5, 3.0}, {3.5, 1.0}, centre, 1.0), std::sqrt(2.0) * 0.75, 1e-12)
      << "a corner between the segment's ends";
}

TEST(SweptDisc, APointPassesBesideACellButNotThroughTheCornerOfTwo) {
  const auto world = drawn_world(
      "...\n"
      "#..\n"
      ".#.\n");
  EXPECT_FALSE(sweep_is_free(world.grid, {}, {0.05, 0.05}, {0.15, 0.15}, 0.0)) << "between two diagonal cells";
  EXPECT_TRUE(sweep_is_free(world.grid, {}, {0.15, 0.15}, {0.25, 0.25}, 0.0));
  EXPECT_TRUE(sweep_is_free(world.grid, {}, {0.105, 0.15}, {0.105, 0.25}, 0.0)) << "along a border";
}

TEST(SweptDisc, UnknownCellsBlockOnlyWhenTheyAreAvoided) {
  const auto world = drawn_world(".....\n..?..\n.....\n");
  GroundRules rules;
  EXPECT_FALSE(sweep_is_free(world.grid, rules, {0.05, 0.15}, {0.45, 0.15}, 0.0));
  rules.unknown = UnknownPolicy::allow;
  EXPECT_TRUE(sweep_is_free(world.grid, rules, {0.05, 0.15}, {0.45, 0.15}, 0.0));
}

TEST(SweptDisc, NumbersThatAreNotFiniteAreNeverFree) {
  const auto world = drawn_world("...\n...\n");
  EXPECT_FALSE(sweep_is_free(world.grid, {}, {NAN, 0.1}, {0.1, 0.1}, 0.0));
  EXPECT_FALSE(sweep_is_free(world.grid, {}, {0.1, 0.1}, {INFINITY, 0.1}, 0.0));
}

TEST(SweptDisc, AgreesWithBruteForceOnRandomGrids) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 400; ++trial) {
    OccupancyGrid grid(0.1);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x) grid.set_log_odds({x, y}, unit(random) < 0.04 ? LogOdds{900} : LogOdds{-900});
    const Pose2 from{1.2 * unit(random), 1.2 * unit(random), 0.0};
    const Pose2 to{1.2 * unit(random), 1.2 * unit(random), 0.0};
    const double radius_m = 0.3 * unit(random);
    const double nearest_m = test::distance_by_brute_force(grid, {from, to}, false, 0.001);
    if (std::abs(nearest_m - radius_m) < 0.001) continue;  // nearer than the oracle can decide
    EXPECT_EQ(sweep_is_free(grid, {}, from.position(), to.position(), radius_m), nearest_m > radius_m)
        << test::drawing_of(grid, {from, to}) << "radius " << radius_m << " m, nearest " << nearest_m << " m";
  }
}

}  // namespace
}  // namespace cairn
