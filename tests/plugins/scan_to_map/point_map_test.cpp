#include "plugins/scan_to_map/point_map.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn::scan_to_map {
namespace {

TEST(PointMap, EchoesOfAWallGiveItsLine) {
  PointMap map(0.1);
  for (int i = 0; i < 9; ++i) map.add({0.01 + 0.01 * i, 0.05});
  const auto line = map.nearest_line({0.05, 0.08}, 0.3);
  ASSERT_TRUE(line);
  EXPECT_NEAR(std::abs(line->normal.y()), 1.0, 1e-9);
  EXPECT_NEAR(line->at_m.y(), 0.05, 1e-9);
}

TEST(PointMap, AHeapOrAFewEchoesGiveNoLine) {
  PointMap map(0.1);
  for (int i = 0; i < 4; ++i) map.add({0.01 + 0.02 * i, 0.05});
  EXPECT_FALSE(map.nearest_line({0.05, 0.05}, 0.3)) << "four echoes";
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y) map.add({1.01 + 0.02 * x, 1.01 + 0.02 * y});
  EXPECT_FALSE(map.nearest_line({1.05, 1.05}, 0.3)) << "a square full";
}

TEST(PointMap, FindsTheNearestLineOfTheNeighboursWithinItsReach) {
  PointMap map(0.1);
  for (int i = 0; i < 9; ++i) {
    map.add({-0.09 + 0.01 * i, 0.05});
    map.add({0.15, 0.01 + 0.01 * i});
  }
  const auto line = map.nearest_line({0.08, 0.05}, 0.3);
  ASSERT_TRUE(line);
  EXPECT_NEAR(std::abs(line->normal.x()), 1.0, 1e-9) << "the wall at x = 0.15 is nearer";
  EXPECT_FALSE(map.nearest_line({0.08, 0.05}, 0.05));
  EXPECT_FALSE(map.nearest_line({5.0, 5.0}, 100.0)) << "no neighbour";
}

TEST(PointMap, AFullCellStandsFast) {
  PointMap map(0.1);
  for (int i = 0; i < PointMap::kMaxPoints; ++i) map.add({0.01 + 0.08 * (i % 9) / 8.0, 0.05});
  for (int i = 0; i < 1000; ++i) map.add({0.05, 0.09});
  EXPECT_NEAR(map.nearest_line({0.05, 0.05}, 0.3)->at_m.y(), 0.05, 1e-9);
}

TEST(PointMap, LeavesOutWhatIsNoPlace) {
  PointMap map(0.1);
  for (const double odd : {1e6, -1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    map.add({odd, 0.0});
    map.add({0.0, odd});
    EXPECT_FALSE(map.nearest_line({odd, 0.0}, 1.0));
  }
  EXPECT_EQ(map.size(), 0U);
}

}  // namespace
}  // namespace cairn::scan_to_map
