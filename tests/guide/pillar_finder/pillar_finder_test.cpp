#include "pillar_finder.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pillar_finder {
namespace {

// '#' occupied, '.' free, '?' unknown, cells of 0.1 m; the lower left character is cell (0, 0).
cairn::OccupancyGrid grid_of(const std::vector<std::string>& rows) {
  cairn::OccupancyGrid grid(0.1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t x = 0; x < rows[i].size(); ++x) {
      const cairn::Cell cell{static_cast<int>(x), static_cast<int>(rows.size() - 1 - i)};
      if (rows[i][x] != '?') grid.set_log_odds(cell, rows[i][x] == '#' ? 1000 : -1000);
    }
  return grid;
}

cairn::DetectionReport detect_in(const cairn::OccupancyGrid& grid, const cairn::Budget& budget = {}) {
  cairn::CellChanges everything;
  const cairn::CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y) everything.spans.push_back({y, box.min.x, box.max.x});
  return PillarFinder({}).detect(grid, everything, budget);
}

TEST(PillarFinder, FindsAPillarWithFreeGroundAllAroundIt) {
  const cairn::DetectionReport report = detect_in(grid_of({"...........",  //
                                                           "...........",  //
                                                           "...........",  //
                                                           "....###....",  //
                                                           "...#???#...",  //
                                                           "...#???#...",  //
                                                           "...#???#...",  //
                                                           "....###....",  //
                                                           "...........",  //
                                                           "...........",  //
                                                           "..........."}));
  ASSERT_EQ(report.matchings.size(), 1U);
  ASSERT_TRUE(report.matchings[0].detection);
  EXPECT_EQ(report.matchings[0].detection->category, "pillar");
  EXPECT_NEAR(report.matchings[0].detection->T_map_landmark.x_m, 0.55, 1e-9);
  EXPECT_NEAR(report.matchings[0].detection->T_map_landmark.y_m, 0.55, 1e-9);
}

TEST(PillarFinder, AWallIsNoPillar) {
  EXPECT_TRUE(detect_in(grid_of({"???????????",  //
                                 "###########",  //
                                 "###########",  //
                                 "..........."}))
                  .matchings.empty());
}

TEST(PillarFinder, APieceOfAWallIsNotTakenForAPillar) {
  const cairn::DetectionReport report = detect_in(grid_of({"???????????",  //
                                                           "???#####???",  //
                                                           "???#####???",  //
                                                           "...........",  //
                                                           "..........."}));
  ASSERT_EQ(report.matchings.size(), 1U);
  EXPECT_FALSE(report.matchings[0].detection) << "what is behind it has not been seen";
}

TEST(PillarFinder, ABudgetOfOneMatchingEndsAfterOne) {
  cairn::Budget budget;
  budget.iterations = 1;
  EXPECT_EQ(detect_in(grid_of({"...........",  //
                               ".###...###.",  //
                               ".###...###.",  //
                               ".###...###.",  //
                               "..........."}),
                      budget)
                .matchings.size(),
            1U);
}

}  // namespace
}  // namespace pillar_finder
