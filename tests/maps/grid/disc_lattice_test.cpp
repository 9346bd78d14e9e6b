#include "maps/grid/disc_lattice.hpp"

#include <gtest/gtest.h>

#include "maps/grid/swept_disc.hpp"
#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

DiscLattice lattice_of(const OccupancyGrid& grid, double radius_m) {
  return {DistanceField(grid, UnknownPolicy::avoid), radius_m};
}

TEST(DiscLattice, AStepIsFreeExactlyWhenTheSweptDiscTouchesNothing) {
  std::mt19937_64 random(3);
  int free = 0;
  int blocked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const OccupancyGrid grid = random_maze(random);
    const double radius_m = 0.01 * static_cast<double>(random() % 9);
    const DiscLattice lattice = lattice_of(grid, radius_m);
    const CellBox box = grid.bounds().grown(1);
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const Point from = grid.centre_of({x, y});
        ASSERT_EQ(lattice.fits({x, y}), sweep_is_free(grid, {}, from, from, radius_m)) << drawing_of(grid);
        for (int step = 0; step < 8; ++step) {
          const Point to = grid.centre_of(Cell{x, y} + DiscLattice::kSteps[step]);
          const bool expected = sweep_is_free(grid, {}, from, to, radius_m);
          ASSERT_EQ(lattice.may_step({x, y}, step), expected) << x << ", " << y << drawing_of(grid);
          ++(expected ? free : blocked);
        }
      }
  }
  EXPECT_GT(free, 2000);
  EXPECT_GT(blocked, 2000);
}

TEST(DiscLattice, CellsThatStepsLeadBetweenAreOnePart) {
  const OccupancyGrid grid = drawn({"..#..", "..#..", ".....", "..#..", "#####", "....."});
  const DiscLattice point = lattice_of(grid, 0.0);
  EXPECT_EQ(point.part_of({0, 3}), point.part_of({4, 5})) << "through the gap";
  EXPECT_NE(point.part_of({0, 0}), point.part_of({0, 3}));
  EXPECT_EQ(point.part_of({2, 2}), 0) << "a wall is no part";
  EXPECT_EQ(point.part_of({-9, 2}), 0) << "nor is what lies outside";
  const DiscLattice wide = lattice_of(grid, 0.06);
  EXPECT_FALSE(wide.fits({2, 3})) << "too wide for the gap";
}

TEST(DiscLattice, AnEmptyGridHasNoPart) {
  EXPECT_FALSE(lattice_of(OccupancyGrid(0.1), 0.2).fits({0, 0}));
}

}  // namespace
}  // namespace cairn
