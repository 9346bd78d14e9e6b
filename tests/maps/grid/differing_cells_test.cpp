#include "maps/grid/differing_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(DifferingCells, OfEqualGridsThereAreNone) {
  OccupancyGrid grid(0.1);
  grid.set_log_odds({3, 4}, 500);
  EXPECT_TRUE(differing_cells(grid, grid).empty());
  EXPECT_TRUE(centres_of_changed_states(grid, grid).empty());
}

TEST(DifferingCells, ABoxOfWholeTilesHoldsThem) {
  OccupancyGrid before(0.1);
  before.set_log_odds({3, 4}, 500);
  OccupancyGrid after = before;
  after.set_log_odds({3, 4}, 501);
  EXPECT_EQ(differing_cells(before, after), (CellBox{{0, 0}, {64, 64}}));
}

TEST(ChangedStates, AreWhereACellBecameFreeOccupiedOrUnknown) {
  OccupancyGrid before(0.1);
  before.set_log_odds({0, 0}, -1000);
  before.set_log_odds({1, 0}, -1000);
  before.set_log_odds({2, 0}, 1000);
  OccupancyGrid after = before;
  after.set_log_odds({1, 0}, 1000);
  after.set_log_odds({2, 0}, 0);
  after.set_log_odds({-70, 5}, -1000);
  EXPECT_THAT(
      centres_of_changed_states(before, after),
      testing::UnorderedElementsAre(after.centre_of({1, 0}), after.centre_of({2, 0}), after.centre_of({-70, 5})));
}

TEST(ChangedStates, MoreEvidenceForTheSameStateIsNoChange) {
  OccupancyGrid before(0.1);
  before.set_log_odds({0, 0}, 600);
  OccupancyGrid after = before;
  after.set_log_odds({0, 0}, 1000);
  EXPECT_THAT(centres_of_changed_states(before, after), testing::IsEmpty());
}

}  // namespace
}  // namespace cairn
