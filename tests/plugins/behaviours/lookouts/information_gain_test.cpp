#include "plugins/behaviours/lookouts/information_gain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cairn::behaviours {
namespace {

// 4 x 4 m about the origin: known free for x < 0, unknown elsewhere, and what is set besides.
OccupancyGrid half_known() {
  OccupancyGrid grid(0.05);
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 0; ++x) grid.set_log_odds({x, y}, -600);
  return grid;
}

FreeSpace space_of(const OccupancyGrid& grid) {
  return FreeSpace(grid, {Point(-1.0, 0.0), 0.2, 0.05}, {});
}

TEST(InformationGain, OfAnOpenEdgeIsTheHalfDiscBehindIt) {
  const double area_m2 = new_area_m2(space_of(half_known()), {-0.025, 0.025}, 1.0);
  // Less the cells of the edge, which the viewpoint's own column cuts in half.
  EXPECT_NEAR(area_m2, 0.5 * std::numbers::pi, 0.15);
}

TEST(InformationGain, SeesNothingThroughAWallAndNothingOutOfRange) {
  OccupancyGrid walled = half_known();
  for (int y = -40; y < 40; ++y) walled.set_log_odds({-1, y}, 600);
  EXPECT_EQ(new_area_m2(space_of(walled), {-0.5, 0.0}, 1.0), 0.0);
  EXPECT_EQ(new_area_m2(space_of(half_known()), {-1.0, 0.0}, 0.9), 0.0);
}

TEST(InformationGain, RanksAsAreaTimesExponentialOfTheWay) {
  // Gonzalez-Banos and Latombe: A exp(-lambda L), with lambda = 1 / 1.5 m.
  const double worth_m = 1.5;
  for (const auto& [area, way, other_area, other_way] :
       {std::array{4.0, 3.0, 1.0, 0.5}, std::array{4.0, 2.0, 1.0, 0.5}, std::array{0.2, 1.0, 6.0, 6.5}}) {
    const bool theirs = area * std::exp(-way / worth_m) > other_area * std::exp(-other_way / worth_m);
    const bool ours = way - worth_of_area_m(area, worth_m) < other_way - worth_of_area_m(other_area, worth_m);
    EXPECT_EQ(ours, theirs);
  }
  EXPECT_TRUE(std::isfinite(worth_of_area_m(0.0, worth_m)));
  EXPECT_EQ(worth_of_area_m(7.0, 0.0), 0.0);
}

}  // namespace
}  // namespace cairn::behaviours
