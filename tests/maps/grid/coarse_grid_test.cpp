#include "maps/grid/coarse_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace cairn {
namespace {

CellSpan random_span(std::mt19937_64& random, int reach) {
  std::uniform_int_distribution<int> index(-reach, reach);
  const int x = index(random);
  return {index(random), x, x + 1 + static_cast<int>(random() % 30)};
}

// Changes cells within some rows and says so with spans that may be wider than the change.
CellChanges random_changes(OccupancyGrid& grid, std::mt19937_64& random, int reach) {
  CellChanges changes;
  const CellSpan first = random_span(random, reach);
  const int rows = 1 + static_cast<int>(random() % 12);
  for (int y = first.y; y < first.y + rows; ++y) {
    changes.spans.push_back({y, first.x_begin, first.x_end});
    for (int x = first.x_begin; x < first.x_end; ++x)
      if (random() % 3 != 0) grid.add_log_odds({x, y}, static_cast<int>(random() % 1200) - 600);
  }
  return changes;
}

TEST(CoarseGrid, EqualsARebuildAfterEveryUpdateToTheLastBit) {
  for (const int n : {1, 2, 3, 5, 8}) {
    std::mt19937_64 random(static_cast<std::uint64_t>(n));
    OccupancyGrid grid(0.05);
    CoarseGrid followed(n, 2.5);
    for (int i = 0; i < 60; ++i) {
      const CellChanges changes = random_changes(grid, random, 5 + 3 * i);  // grows on all sides
      const std::vector<Cell> touched = followed.update(grid, changes);
      CoarseGrid rebuilt(n, 2.5);
      rebuilt.rebuild(grid);
      ASSERT_EQ(followed, rebuilt) << "n " << n << ", update " << i;
      ASSERT_TRUE(std::is_sorted(touched.begin(), touched.end(),
                                 [](Cell a, Cell b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }));
      ASSERT_EQ(std::adjacent_find(touched.begin(), touched.end()), touched.end());
    }
  }
}

TEST(CoarseGrid, NamesEveryCoarseCellThatChanged) {
  std::mt19937_64 random(11);
  OccupancyGrid grid(0.05);
  CoarseGrid coarse(5, 3.0);
  for (int i = 0; i < 40; ++i) {
    const CoarseGrid before = coarse;
    const std::vector<Cell> touched = coarse.update(grid, random_changes(grid, random, 60));
    const CellBox box = coarse.bounds();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (coarse.ol({x, y}) != before.ol({x, y})) {
          ASSERT_NE(std::find(touched.begin(), touched.end(), Cell{x, y}), touched.end()) << x << ", " << y;
        }
  }
}

TEST(CoarseGrid, IsTheMeanWithWeightAlphaAboveEquiprobable) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 512);
  grid.set_log_odds({1, 0}, -512);
  grid.set_log_odds({0, 1}, 300);
  CoarseGrid coarse(2, 4.0);
  coarse.rebuild(grid);
  const double high = grid.ol({0, 0}) + grid.ol({0, 1});
  const double low = grid.ol({1, 0}) + 127;
  EXPECT_DOUBLE_EQ(coarse.ol({0, 0}), (low + 4.0 * high) / (2 + 4.0 * 2));
}

TEST(CoarseGrid, AgreesWithThePlainFormulaEverywhere) {
  std::mt19937_64 random(5);
  OccupancyGrid grid(0.05);
  for (int i = 0; i < 20; ++i) (void)random_changes(grid, random, 40);
  constexpr int n = 3;
  constexpr double alpha = 2.0;
  CoarseGrid coarse(n, alpha);
  coarse.rebuild(grid);
  const CellBox box = coarse.bounds();
  for (int k = box.min.y - 1; k <= box.max.y; ++k)
    for (int h = box.min.x - 1; h <= box.max.x; ++h) {
      double sum = 0.0;
      double weights = 0.0;
      for (int y = k * n; y < (k + 1) * n; ++y)
        for (int x = h * n; x < (h + 1) * n; ++x) {
          const double weight = grid.ol({x, y}) <= 127 ? 1.0 : alpha;
          sum += weight * grid.ol({x, y});
          weights += weight;
        }
      ASSERT_NEAR(coarse.ol({h, k}), sum / weights, 1e-9);
    }
}

TEST(CoarseGrid, IsUnknownWhereNothingWasSeen) {
  OccupancyGrid grid(0.05);
  CoarseGrid coarse(5, 3.0);
  EXPECT_EQ(coarse.ol({0, 0}), 127.0);
  EXPECT_TRUE(coarse.update(grid, {}).empty());
  EXPECT_TRUE(coarse.bounds().empty());
  grid.include({{-7, 0}, {3, 4}});
  EXPECT_TRUE(coarse.update(grid, {}).empty());
  EXPECT_EQ(coarse.bounds(), (CellBox{{-2, 0}, {1, 1}}));
  EXPECT_EQ(coarse.ol({-1, 0}), 127.0);
}

TEST(CoarseGrid, CutsSpansThatReachBeyondTheGrid) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 100);
  CoarseGrid coarse(5, 3.0);
  EXPECT_EQ(coarse.update(grid, {{{0, -100, 100}, {50, 7, 7}}}), (std::vector<Cell>{{0, 0}}));
  CoarseGrid rebuilt(5, 3.0);
  rebuilt.rebuild(grid);
  EXPECT_EQ(coarse, rebuilt);
}

TEST(CoarseGrid, TakesInAGridThatAlreadyHoldsSomething) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({12, -40}, 700);
  CoarseGrid followed(5, 3.0);
  (void)followed.update(grid, {});
  CoarseGrid rebuilt(5, 3.0);
  rebuilt.rebuild(grid);
  EXPECT_EQ(followed, rebuilt);
}

TEST(CoarseGrid, DividesTowardsMinusInfinity) {
  const CoarseGrid coarse(5, 3.0);
  EXPECT_EQ(coarse.coarse_of({-1, 0}), (Cell{-1, 0}));
  EXPECT_EQ(coarse.coarse_of({-5, 4}), (Cell{-1, 0}));
  EXPECT_EQ(coarse.coarse_of({-6, 5}), (Cell{-2, 1}));
  for (int y = -3; y < 3; ++y)
    for (int x = -3; x < 3; ++x) {
      const CellBox box = coarse.fine_box({x, y});
      EXPECT_EQ(coarse.coarse_of(box.min), (Cell{x, y}));
      EXPECT_EQ(coarse.coarse_of(box.max - Cell{1, 1}), (Cell{x, y}));
      EXPECT_EQ(box.width(), 5);
    }
}

TEST(CoarseGrid, RefusesSizesAndWeightsThatMakeNoSense) {
  EXPECT_THROW(CoarseGrid(0, 2.0), std::invalid_argument);
  EXPECT_THROW(CoarseGrid(1025, 2.0), std::invalid_argument);
  EXPECT_THROW(CoarseGrid(5, 1.0), std::invalid_argument);
  EXPECT_THROW(CoarseGrid(5, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
