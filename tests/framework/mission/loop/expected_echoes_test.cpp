#include "framework/mission/loop/expected_echoes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn {
namespace {

// Free from x = 0 to the wall at x = wall_m, which leans by a slope.
OccupancyGrid grid_with_wall(double wall_m, double slope = 0.0) {
  OccupancyGrid grid(0.05);
  for (int x = -10; x < 80; ++x)
    for (int y = -40; y < 40; ++y) {
      const Point at = grid.centre_of({x, y});
      const double beyond_m = at.x() - wall_m - slope * at.y();
      if (beyond_m < 0.0) grid.set_log_odds({x, y}, -800);
      if (beyond_m >= 0.0 && beyond_m < 0.1) grid.set_log_odds({x, y}, 800);
    }
  return grid;
}

std::optional<double> expected(const OccupancyGrid& grid, const Pose2& T_map_sensor = {},
                               const DeafConfig& config = {}) {
  return expected_echo_m(grid, T_map_sensor, radians(15.0), config);
}

TEST(ExpectedEchoes, AWallThatFillsTheBeamIsExpectedToEcho) {
  const auto range_m = expected(grid_with_wall(1.2));
  ASSERT_TRUE(range_m);
  EXPECT_NEAR(*range_m, 1.2, 0.06);
}

TEST(ExpectedEchoes, AWallFarAwayIsNot) {
  EXPECT_FALSE(expected(grid_with_wall(2.3)));
  EXPECT_TRUE(expected(grid_with_wall(2.3), {}, {.within_m = 3.0}));
}

TEST(ExpectedEchoes, AWallSeenAtASlantIsNot) {
  EXPECT_TRUE(expected(grid_with_wall(1.2, std::tan(radians(8.0)))));
  EXPECT_FALSE(expected(grid_with_wall(1.2, std::tan(radians(25.0)))));
  EXPECT_FALSE(expected(grid_with_wall(1.2), {0.0, 0.0, radians(30.0)}));
}

TEST(ExpectedEchoes, WhatFillsOnlyAPartOfTheBeamIsNot) {
  OccupancyGrid grid = grid_with_wall(3.5);
  for (int y = -2; y < 2; ++y) grid.set_log_odds({24, y}, 800);
  EXPECT_FALSE(expected(grid));
}

TEST(ExpectedEchoes, NothingIsExpectedBehindUnknownSpaceOrOfAWallThatIsUncertain) {
  OccupancyGrid hidden = grid_with_wall(1.2);
  for (int y = -20; y < 20; ++y)
    for (int x = 8; x < 14; ++x) hidden.set_log_odds({x, y}, 0);
  EXPECT_FALSE(expected(hidden));
  OccupancyGrid uncertain = grid_with_wall(1.2);
  for (int y = -20; y < 20; ++y)
    for (int x = 23; x < 28; ++x) uncertain.set_log_odds({x, y}, 200);
  EXPECT_FALSE(expected(uncertain));
}

TEST(ExpectedEchoes, OnlyReadingsOfConesWithoutEchoAreAskedAndOnlyWhileThePoseIsSure) {
  const OccupancyGrid grid = grid_with_wall(1.2);
  Observation seen;
  seen.ranges.resize(4);
  for (int i = 0; i < 4; ++i) {
    RangeReading& reading = seen.ranges[static_cast<std::size_t>(i)];
    reading = {{}, radians(15.0), 0.1, 5.0, std::numeric_limits<double>::infinity(), i};
  }
  seen.ranges[1].range_m = 1.2;
  seen.ranges[2].half_beam_rad = 0.0;
  seen.ranges[3].range_m = 5.0;
  PoseEstimate pose;
  const std::vector<ExpectedEcho> echoes = expected_echoes(seen, grid, pose, {});
  ASSERT_EQ(echoes.size(), 2U);
  EXPECT_EQ(echoes[0].sensor, 0);
  EXPECT_EQ(echoes[1].sensor, 3) << "as far as it reaches is no echo";
  pose.covariance(0, 0) = 0.2 * 0.2;
  EXPECT_TRUE(expected_echoes(seen, grid, pose, {}).empty());
}

}  // namespace
}  // namespace cairn
