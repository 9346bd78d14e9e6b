#include "plugins/behaviours/local_map/speckles.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

const std::string kRoom = R"(
####################
#..................#
#..##........####..#
#..# ........####..#
#............####..#
#..................#
#......A...........#
####################
)";

TEST(Speckles, AreSmallGroupsThatStandAlone) {
  const AsciiGrid map(kRoom);
  const std::vector<Cell> speckles = speckles_of(map.grid, map.grid.bounds());
  // Three occupied cells and the unknown one beside them; neither the walls nor the cabinet.
  EXPECT_EQ(speckles, (std::vector<Cell>{{3, 4}, {3, 5}, {4, 4}, {4, 5}}));
}

TEST(Speckles, LargerOnesAreWhenTheyAreAllowedToBe) {
  const AsciiGrid map(kRoom);
  EXPECT_EQ(speckles_of(map.grid, map.grid.bounds(), {12, 80}).size(), 4U + 12U);
  EXPECT_EQ(speckles_of(map.grid, map.grid.bounds(), {4, 3}).size(), 0U) << "four cells in all";
}

TEST(Speckles, WhatReachesTheRimOfTheBoxIsNone) {
  const AsciiGrid map(kRoom);
  EXPECT_TRUE(speckles_of(map.grid, {{4, 4}, {9, 8}}).empty());
  EXPECT_TRUE(speckles_of(map.grid, CellBox{}).empty());
}

}  // namespace
}  // namespace cairn::behaviours
