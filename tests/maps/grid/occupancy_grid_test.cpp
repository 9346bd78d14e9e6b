#include "maps/grid/occupancy_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

namespace cairn {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Prevision, IsTheFloorOf255TimesTheProbability) {
  for (int l = -32768; l <= 32767; ++l)
    ASSERT_EQ(ol_of(static_cast<LogOdds>(l)), std::floor(255.0 / (1.0 + std::exp(-l / 256.0)))) << l;
  EXPECT_EQ(ol_of(0), 127);
  EXPECT_EQ(ol_of(-32768), 0);
  EXPECT_EQ(ol_of(32767), 255);  // 1 - P is below what a double near 1 can hold
}

TEST(LogOdds, GoToProbabilitiesAndBack) {
  for (int l = -2000; l <= 2000; ++l) EXPECT_EQ(log_odds_of(probability_of(static_cast<LogOdds>(l))), l);
  EXPECT_EQ(log_odds_of(0.5), 0);
  EXPECT_EQ(log_odds_of(0.0), -32768);
  EXPECT_EQ(log_odds_of(1.0), 32767);
}

TEST(LogOdds, RefuseWhatIsNoProbability) {
  for (const double p : {-0.01, 1.01, kNaN, kInfinity}) EXPECT_THROW((void)log_odds_of(p), std::invalid_argument) << p;
}

TEST(Thresholds, LeaveUnknownWhatLiesBetween) {
  const OccupancyThresholds thresholds = OccupancyThresholds::of(0.35, 0.65);
  EXPECT_EQ(thresholds.free_below, OccupancyThresholds{}.free_below);
  EXPECT_EQ(thresholds.occupied_above, OccupancyThresholds{}.occupied_above);
  EXPECT_EQ(thresholds.state(0), CellState::unknown);
  EXPECT_EQ(thresholds.state(thresholds.free_below), CellState::unknown);
  EXPECT_EQ(thresholds.state(static_cast<LogOdds>(thresholds.free_below - 1)), CellState::free);
  EXPECT_EQ(thresholds.state(thresholds.occupied_above), CellState::unknown);
  EXPECT_EQ(thresholds.state(static_cast<LogOdds>(thresholds.occupied_above + 1)), CellState::occupied);
}

TEST(OccupancyGrid, AnswersUnknownWhereNothingWasWritten) {
  const OccupancyGrid grid(0.05);
  EXPECT_TRUE(grid.bounds().empty());
  for (const Cell cell : {Cell{0, 0}, Cell{-1, -1}, Cell{100000, -100000}}) {
    EXPECT_EQ(grid.log_odds(cell), 0);
    EXPECT_EQ(grid.ol(cell), kUnknownOl);
    EXPECT_EQ(grid.state(cell), CellState::unknown);
  }
  EXPECT_EQ(known_ratio(grid), 0.0);
}

TEST(OccupancyGrid, GrowsOnAllSidesWithoutMovingWhatItHolds) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> index(-700, 700);
  std::uniform_int_distribution<int> value(-1000, 1000);
  OccupancyGrid grid(0.05);
  std::map<Cell, LogOdds> written;
  CellBox box;
  for (int i = 0; i < 2000; ++i) {
    // The range widens, so that the grid keeps growing to the left, right, up and down.
    const Cell cell{index(random) * (i + 1) / 2000, index(random) * (i + 1) / 2000};
    const auto l = static_cast<LogOdds>(value(random));
    grid.set_log_odds(cell, l);
    written[cell] = l;
    box = united(box, {cell, cell + Cell{1, 1}});
    ASSERT_EQ(grid.bounds(), box);
  }
  EXPECT_LT(box.min.x, -600);
  EXPECT_LT(box.min.y, -600);
  for (int y = box.min.y - 2; y < box.max.y + 2; ++y)
    for (int x = box.min.x - 2; x < box.max.x + 2; ++x) {
      const auto found = written.find({x, y});
      ASSERT_EQ(grid.log_odds({x, y}), found == written.end() ? 0 : found->second) << x << ", " << y;
    }
}

TEST(OccupancyGrid, KeepsTheCellsAroundATileCornerApart) {
  OccupancyGrid grid(0.05);
  LogOdds l = 1;
  for (const int y : {-65, -64, -1, 0, 63, 64})
    for (const int x : {-65, -64, -1, 0, 63, 64}) grid.set_log_odds({x, y}, l++);
  l = 1;
  for (const int y : {-65, -64, -1, 0, 63, 64})
    for (const int x : {-65, -64, -1, 0, 63, 64}) EXPECT_EQ(grid.log_odds({x, y}), l++);
}

TEST(OccupancyGrid, ClampsWhateverIsWritten) {
  OccupancyGrid grid(0.05, 4.0);
  EXPECT_EQ(grid.clamp_nat(), 4.0);
  grid.set_log_odds({0, 0}, 30000);
  EXPECT_EQ(grid.log_odds({0, 0}), 1024);
  grid.set_log_odds({0, 0}, -30000);
  EXPECT_EQ(grid.log_odds({0, 0}), -1024);
  grid.add_log_odds({0, 0}, std::numeric_limits<int>::max());
  EXPECT_EQ(grid.log_odds({0, 0}), 1024);
  grid.add_log_odds({0, 0}, std::numeric_limits<int>::min());
  EXPECT_EQ(grid.log_odds({0, 0}), -1024);
}

TEST(OccupancyGrid, SaysWhetherAnAdditionChangedTheCell) {
  OccupancyGrid grid(0.05, 1.0);
  EXPECT_TRUE(grid.add_log_odds({2, 3}, 256));
  EXPECT_FALSE(grid.add_log_odds({2, 3}, 1));
  EXPECT_FALSE(grid.add_log_odds({2, 3}, 0));
  EXPECT_TRUE(grid.add_log_odds({2, 3}, -1));
}

TEST(OccupancyGrid, CopiesDeeply) {
  OccupancyGrid original(0.05);
  original.set_log_odds({-3, 7}, 100);
  OccupancyGrid copy = original;
  EXPECT_EQ(copy, original);
  copy.set_log_odds({-3, 7}, 200);
  copy.set_log_odds({500, 500}, 1);
  EXPECT_EQ(original.log_odds({-3, 7}), 100);
  EXPECT_EQ(original.bounds(), (CellBox{{-3, 7}, {-2, 8}}));
  EXPECT_NE(copy, original);
  copy = original;
  EXPECT_EQ(copy, original);
  const OccupancyGrid moved = std::move(copy);
  EXPECT_EQ(moved, original);
}

TEST(OccupancyGrid, IncludesABoxAsUnknown) {
  OccupancyGrid grid(0.05);
  grid.include({{-10, -20}, {30, 40}});
  grid.include({});
  grid.include({{5, 5}, {5, 9}});
  EXPECT_EQ(grid.bounds(), (CellBox{{-10, -20}, {30, 40}}));
  EXPECT_EQ(known_ratio(grid), 0.0);
  grid.set_log_odds({0, 0}, 500);
  grid.set_log_odds({1, 0}, -500);
  EXPECT_EQ(grid.bounds(), (CellBox{{-10, -20}, {30, 40}}));
}

TEST(OccupancyGrid, KnownRatioCountsWithinTheBoxOfTheOccupiedCells) {
  OccupancyGrid grid(0.05);
  grid.include({{-10, -20}, {30, 40}});
  grid.set_log_odds({5, 5}, -500);
  EXPECT_DOUBLE_EQ(known_ratio(grid), 1.0 / (40 * 60)) << "no wall yet: all of the map";
  grid.set_log_odds({0, 0}, 500);
  grid.set_log_odds({9, 4}, 500);
  grid.set_log_odds({3, 3}, -500);
  EXPECT_DOUBLE_EQ(known_ratio(grid), 3.0 / (10 * 5));
}

TEST(OccupancyGrid, CopiesBoxesCellByCellInRowOrder) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> index(-150, 150);
  OccupancyGrid grid(0.05);
  for (int i = 0; i < 400; ++i)
    grid.set_log_odds({index(random), index(random) / 3}, static_cast<LogOdds>(random() % 2000));
  for (int i = 0; i < 50; ++i) {
    const Cell a{index(random) * 2, index(random) * 2};
    const CellBox box{a, {a.x + static_cast<int>(random() % 200), a.y + static_cast<int>(random() % 100)}};
    std::vector<LogOdds> log_odds(static_cast<std::size_t>(box.width()) * box.height());
    std::vector<std::uint8_t> ol(log_odds.size());
    grid.copy_log_odds(box, log_odds);
    grid.copy_ol(box, ol);
    std::size_t k = 0;
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x, ++k) {
        ASSERT_EQ(log_odds[k], grid.log_odds({x, y}));
        ASSERT_EQ(ol[k], grid.ol({x, y}));
      }
  }
}

TEST(OccupancyGrid, FindsTheCellOfAPointAlsoBelowItsOrigin) {
  const OccupancyGrid grid(0.25, 4.0, {1.0, -2.0});
  EXPECT_EQ(grid.cell_at({1.0, -2.0}), (Cell{0, 0}));
  EXPECT_EQ(grid.cell_at({1.24, -1.76}), (Cell{0, 0}));
  EXPECT_EQ(grid.cell_at({1.25, -1.75}), (Cell{1, 1}));
  EXPECT_EQ(grid.cell_at({0.99, -2.01}), (Cell{-1, -1}));
  for (const Cell cell : {Cell{0, 0}, Cell{-7, 12}, Cell{300, -41}})
    EXPECT_EQ(grid.cell_at(grid.centre_of(cell)), cell);
}

TEST(OccupancyGrid, KeepsWildPointsAtTheRimOfTheLattice) {
  const OccupancyGrid grid(0.05);
  EXPECT_EQ(grid.cell_at({1e300, -1e300}), (Cell{1 << 30, -(1 << 30)}));
  EXPECT_EQ(grid.cell_at({kInfinity, -kInfinity}), (Cell{1 << 30, -(1 << 30)}));
  EXPECT_EQ(grid.log_odds(grid.cell_at({kNaN, kNaN})), 0);
}

TEST(OccupancyGrid, RefusesToGrowBeyondReason) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({1, 1}, 5);
  EXPECT_THROW(grid.set_log_odds({1 << 30, 0}, 1), std::length_error);
  EXPECT_THROW(grid.include({{-(1 << 30), 0}, {1, 1}}), std::length_error);
  EXPECT_EQ(grid.bounds(), (CellBox{{1, 1}, {2, 2}}));
}

TEST(OccupancyGrid, NamesTheValueThatItRefuses) {
  const auto text = [](double cell_m, double clamp_nat) -> std::string {
    try {
      const OccupancyGrid grid(cell_m, clamp_nat);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(text(0.0, 4.0), "OccupancyGrid: cell_m must be positive, got 0.000000");
  EXPECT_THAT(text(kNaN, 4.0), testing::HasSubstr("cell_m must be positive"));
  for (const double clamp : {0.0, -1.0, 128.0, 1e12, kNaN, kInfinity})
    EXPECT_THAT(text(0.05, clamp), testing::StartsWith("OccupancyGrid: clamp_nat must be in [1/256, 127]")) << clamp;
  EXPECT_THROW(OccupancyGrid(0.05, 4.0, {kNaN, 0.0}), std::invalid_argument);
}

TEST(OccupancyGrid, APartIsWhatItHoldsInsideTheBox) {
  OccupancyGrid grid(0.1, 4.0, {-3.0, 2.0});
  grid.include({{-20, 10}, {180, 110}});
  std::mt19937_64 random(3);
  for (int i = 0; i < 3000; ++i)
    grid.set_log_odds({static_cast<int>(random() % 200) - 20, static_cast<int>(random() % 100) + 10},
                      static_cast<LogOdds>(static_cast<int>(random() % 2000) - 1000));
  for (const CellBox& box :
       {CellBox{{-7, 30}, {100, 75}}, CellBox{{-500, 0}, {64, 64}}, grid.bounds(), CellBox{{900, 900}, {910, 910}}}) {
    const OccupancyGrid part = part_of(grid, box);
    const CellBox within = intersected(box, grid.bounds());
    EXPECT_EQ(part.bounds(), within);
    for (int y = 0; y < 120; ++y)
      for (int x = -30; x < 190; ++x)
        ASSERT_EQ(part.log_odds({x, y}), within.contains({x, y}) ? grid.log_odds({x, y}) : 0) << x << ", " << y;
  }
}

}  // namespace
}  // namespace cairn
