#include "maps/grid/distance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "maps/grid/differing_cells.hpp"
#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

bool blocks(CellState state, UnknownPolicy unknown) {
  return state == CellState::occupied || (state == CellState::unknown && unknown == UnknownPolicy::avoid);
}

// The nearest blocked cell by looking at all cells of the box.
double naive_distance_m(const OccupancyGrid& grid, const CellBox& box, UnknownPolicy unknown, Cell from) {
  double nearest = std::hypot(box.width(), box.height());
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (blocks(grid.state({x, y}), unknown)) nearest = std::min(nearest, std::hypot(x - from.x, y - from.y));
  return nearest * grid.cell_m();
}

OccupancyGrid random_grid(std::mt19937_64& random, int one_in) {
  OccupancyGrid grid(0.05);
  const Cell corner{static_cast<int>(random() % 100) - 80, static_cast<int>(random() % 100) - 80};
  const int width = 5 + static_cast<int>(random() % 40);
  const int height = 5 + static_cast<int>(random() % 40);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto draw = static_cast<int>(random() % static_cast<unsigned>(one_in));
      grid.set_log_odds(corner + Cell{x, y}, draw == 0 ? LogOdds{900} : draw == 1 ? LogOdds{0} : LogOdds{-900});
    }
  return grid;
}

TEST(DistanceField, EqualsTheNaiveTransform) {
  std::mt19937_64 random(21);
  for (int i = 0; i < 30; ++i) {
    const OccupancyGrid grid = random_grid(random, 4 << (i % 6));
    for (const UnknownPolicy unknown : {UnknownPolicy::avoid, UnknownPolicy::allow}) {
      const DistanceField field(grid, unknown);
      const CellBox box = field.box();
      ASSERT_EQ(box, grid.bounds().grown(1));
      for (int y = box.min.y; y < box.max.y; ++y)
        for (int x = box.min.x; x < box.max.x; ++x)
          ASSERT_EQ(field.distance_m({x, y}), static_cast<float>(naive_distance_m(grid, box, unknown, {x, y})))
              << x << ", " << y << drawing_of(grid);
    }
  }
}

TEST(DistanceField, TakesTheRimForAWallWhenUnknownSpaceIsAvoided) {
  const DistanceField field(drawn({".....", ".....", "....."}), UnknownPolicy::avoid);
  EXPECT_FLOAT_EQ(field.distance_m({2, 1}), 0.2F);
  EXPECT_FLOAT_EQ(field.distance_m({0, 0}), 0.1F);
  EXPECT_TRUE(field.is_blocked({-1, 0}));
}

TEST(DistanceField, IsNotRepelledByTheRimWhenUnknownSpaceIsAllowed) {
  const OccupancyGrid grid = drawn({".....", ".....", "....#"});
  const DistanceField field(grid, UnknownPolicy::allow);
  EXPECT_FLOAT_EQ(field.distance_m({0, 0}), 0.4F);
  EXPECT_FALSE(field.is_blocked({-1, 0}));
  EXPECT_TRUE(field.is_blocked({-2, 0}));  // beyond the box nobody goes
}

TEST(DistanceField, HoldsTheDiagonalWhenNothingIsBlocked) {
  const DistanceField field(drawn({"...", "..?"}), UnknownPolicy::allow);
  EXPECT_FLOAT_EQ(field.distance_m({0, 0}), static_cast<float>(std::hypot(5, 4) * 0.1));
}

TEST(DistanceField, OfAnEmptyGridBlocksEverything) {
  const DistanceField field(OccupancyGrid(0.05), UnknownPolicy::allow);
  EXPECT_TRUE(field.box().empty());
  EXPECT_TRUE(field.is_blocked({0, 0}));
  EXPECT_EQ(field.clearance_m({0.0, 0.0}), 0.0);
  EXPECT_TRUE(DistanceField().is_blocked({0, 0}));
}

TEST(DistanceField, ObeysTheThresholdsItIsGiven) {
  OccupancyGrid grid(0.1);
  grid.include({{0, 0}, {5, 1}});
  for (int x = 0; x < 5; ++x) grid.set_log_odds({x, 0}, -100);
  EXPECT_TRUE(DistanceField(grid, UnknownPolicy::avoid).is_blocked({2, 0}));
  EXPECT_FALSE(DistanceField(grid, UnknownPolicy::avoid, {-50, 50}).is_blocked({2, 0}));
}

// Least distance of a point to a cell's square.
double to_square_m(const Point& p, const Point& centre, double cell_m) {
  return std::hypot(std::max(0.0, std::abs(p.x() - centre.x()) - cell_m / 2.0),
                    std::max(0.0, std::abs(p.y() - centre.y()) - cell_m / 2.0));
}

TEST(DistanceField, NeverPromisesMoreClearanceThanThereIs) {
  std::mt19937_64 random(22);
  for (int i = 0; i < 10; ++i) {
    const OccupancyGrid grid = random_grid(random, 60);
    const DistanceField field(grid, UnknownPolicy::avoid);
    const CellBox box = field.box();
    std::uniform_real_distribution<double> x_m(box.min.x * 0.05, box.max.x * 0.05);
    std::uniform_real_distribution<double> y_m(box.min.y * 0.05, box.max.y * 0.05);
    for (int k = 0; k < 60; ++k) {
      const Point p{x_m(random), y_m(random)};
      double nearest = 1e9;
      for (int y = box.min.y; y < box.max.y; ++y)
        for (int x = box.min.x; x < box.max.x; ++x)
          if (field.is_blocked({x, y})) nearest = std::min(nearest, to_square_m(p, field.centre_of({x, y}), 0.05));
      EXPECT_LE(field.clearance_m(p), nearest + 1e-6);
      EXPECT_GE(field.clearance_m(p), 0.0);
      EXPECT_GE(field.clearance_m(p), nearest - 2.0 * std::sqrt(2.0) * 0.05 - 1e-6);
    }
  }
}

TEST(DistanceField, HasTheGridsLattice) {
  OccupancyGrid grid(0.25, 4.0, {1.0, -2.0});
  grid.set_log_odds({-3, 4}, -500);
  const DistanceField field(grid, UnknownPolicy::avoid);
  EXPECT_EQ(field.cell_m(), 0.25);
  EXPECT_EQ(field.origin_m(), grid.origin_m());
  EXPECT_EQ(field.cell_at({0.3, -0.9}), grid.cell_at({0.3, -0.9}));
  EXPECT_EQ(field.centre_of({-3, 4}), grid.centre_of({-3, 4}));
}

TEST(DistanceField, FollowingAGridIsAsMakingItAnew) {
  std::mt19937_64 random(5);
  for (const UnknownPolicy unknown : {UnknownPolicy::avoid, UnknownPolicy::allow}) {
    OccupancyGrid grid(0.1);
    for (int y = -20; y < 130; ++y)
      for (int x = -10; x < 170; ++x) grid.set_log_odds({x, y}, random() % 200 == 0 ? LogOdds{900} : LogOdds{-900});
    DistanceField field(grid, unknown);
    for (int round = 0; round < 60; ++round) {
      const OccupancyGrid before = grid;
      const Cell at{static_cast<int>(random() % 170) - 8, static_cast<int>(random() % 140) - 18};
      const int side = 1 + static_cast<int>(random() % 12);
      const auto value = static_cast<LogOdds>(round % 3 == 0 ? 900 : round % 3 == 1 ? -900 : 0);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) grid.set_log_odds(at + Cell{x, y}, value);
      if (round == 40)  // all that is left to be near to goes
        for (int y = -20; y < 130; ++y)
          for (int x = -10; x < 170; ++x) grid.set_log_odds({x, y}, LogOdds{-900});
      field.follow(grid, unknown, {},
                   round % 2 == 0 ? differing_cells(before, grid)
                                  : CellBox{at, at + Cell{side, side}}.grown(round == 40 ? 400 : 0));
      const DistanceField fresh(grid, unknown);
      ASSERT_EQ(field.box(), fresh.box());
      for (int y = fresh.box().min.y; y < fresh.box().max.y; ++y)
        for (int x = fresh.box().min.x; x < fresh.box().max.x; ++x)
          ASSERT_EQ(field.distance_m({x, y}), fresh.distance_m({x, y}))
              << "round " << round << ", cell " << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace cairn
