#include "framework/reporting/grid_history.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "maps/base/deflate.hpp"

namespace cairn {
namespace {

using Cells = std::map<Cell, std::string>;  // of each tile

Cells cells_of(const OccupancyGrid& grid) {
  Cells cells;
  for (const Cell& tile : tiles_written(grid)) {
    const GridTile copied = copied_tile(grid, tile);
    cells[tile].assign(copied.ol.begin(), copied.ol.end());
  }
  return cells;
}

// As the deltas up to then tell of it.
Cells told_at(const GridHistory& history, double time_s) {
  Cells cells;
  for (const GridDelta& delta : history.deltas()) {
    if (delta.time_s > time_s) break;
    for (const auto& [tile, packed] : delta.packed_ol) cells[tile] = inflated(packed, GridTile::kCells);
  }
  return cells;
}

// Writes a cell anywhere within so many cells of the origin.
CellChanges write_anywhere(OccupancyGrid& grid, int within, std::mt19937& random) {
  const auto place = [&] { return static_cast<int>(random() % static_cast<unsigned>(2 * within)) - within; };
  const Cell cell{place(), place()};
  grid.set_log_odds(cell, random() % 2 == 0 ? 400 : -400);
  return {{{cell.y, cell.x, cell.x + 1}}};
}

TEST(GridHistory, DeltasAddUpToTheGridAsItWas) {
  std::mt19937 random(7);
  OccupancyGrid grid(0.05);
  grid.set_log_odds({-200, 3}, 400);  // before the run
  GridHistory history;
  std::map<double, Cells> was;
  for (int tick = 0; tick < 20'000; ++tick) {  // ten times as many as it keeps
    const CellChanges changes = write_anywhere(grid, 300, random);
    const double time_s = 0.1 * tick;
    history.note(time_s, grid, &changes);
    if (!history.deltas().empty() && history.deltas().back().time_s == time_s) was[time_s] = cells_of(grid);
  }
  EXPECT_LE(history.deltas().size(), GridHistory::kMaxDeltas);
  EXPECT_GE(history.deltas().size(), GridHistory::kMaxDeltas / 2);
  for (const GridDelta& delta : history.deltas()) EXPECT_EQ(told_at(history, delta.time_s), was.at(delta.time_s));
}

TEST(GridHistory, AnotherGridIsToldWhole) {
  OccupancyGrid first(0.05);
  OccupancyGrid second(0.05);
  first.set_log_odds({0, 0}, 400);
  second.set_log_odds({0, 0}, -400);
  second.set_log_odds({100, 0}, -400);
  GridHistory history;
  history.note(0.0, first, nullptr);
  history.note(5.0, second, nullptr);
  history.note(9.0, second, nullptr);  // nothing new
  ASSERT_EQ(history.deltas().size(), 2U);
  EXPECT_EQ(told_at(history, 0.0), cells_of(first));
  EXPECT_EQ(told_at(history, 5.0), cells_of(second));
}

TEST(GridHistory, TakesNoMoreMemoryThanItMay) {
  constexpr std::size_t kMaxBytes = 100'000;
  std::mt19937 random(8);
  OccupancyGrid grid(0.05);
  GridHistory history(kMaxBytes);
  std::size_t most = 0;
  for (int tick = 0; tick < 500; ++tick) {
    CellChanges changes = write_anywhere(grid, 300, random);
    history.note(1.0 * tick, grid, &changes);
    std::size_t bytes = 0;
    for (const GridDelta& delta : history.deltas())
      for (const auto& [tile, packed] : delta.packed_ol) bytes += packed.size();
    most = std::max(most, bytes);
  }
  EXPECT_LE(most, kMaxBytes);
  EXPECT_EQ(told_at(history, history.deltas().back().time_s).size(), cells_of(grid).size());

  // So large a grid that not even a few deltas fit: there is no history, and none begins.
  for (int tick = 0; tick < 200; ++tick) {
    CellChanges changes;
    for (int i = 0; i < 200; ++i) changes.spans.push_back(write_anywhere(grid, 2000, random).spans.front());
    history.note(1000.0 + tick, grid, &changes);
  }
  EXPECT_TRUE(history.deltas().empty());
}

}  // namespace
}  // namespace cairn
