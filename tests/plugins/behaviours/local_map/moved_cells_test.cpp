#include "plugins/behaviours/local_map/moved_cells.hpp"

#include <gtest/gtest.h>

namespace cairn::behaviours {
namespace {

TEST(MovedCells, LieWhereTheMapHasTakenThem) {
  const OccupancyGrid grid(0.05);
  CellSet cells;
  for (int x = 0; x < 40; ++x) cells.insert({x, -7});
  // By 1 m and 0.5 m.
  const CellSet moved = moved_cells({{{0.0, 0.0, 0.0}}, {{1.0, 0.5, 0.0}}}, grid, cells);
  for (int x = 0; x < 40; ++x) {
    EXPECT_TRUE(moved.contains({x + 20, 3})) << x;
    EXPECT_FALSE(moved.contains({x, -7})) << x;
  }
}

TEST(MovedCells, MoveAsTheWayNearThem) {
  const OccupancyGrid grid(0.05);
  CellSet cells;
  cells.insert(grid.cell_at({0.5, 0.5}));
  cells.insert(grid.cell_at({8.0, 0.5}));
  const CellSet moved =
      moved_cells({{{0.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}, {8.0, 1.0, 0.0}}}, grid, cells);
  EXPECT_TRUE(moved.contains(grid.cell_at({0.5, 0.5})));
  EXPECT_TRUE(moved.contains(grid.cell_at({8.0, 1.5})));
  EXPECT_FALSE(moved.contains(grid.cell_at({8.0, 0.5})));
}

}  // namespace
}  // namespace cairn::behaviours
