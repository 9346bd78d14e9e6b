#include "framework/mission/hearing/expected_echoes.hpp"

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

enum class Expectation { none, uncertain, certain };

Expectation expected(const OccupancyGrid& grid, const Pose2& T_map_sensor = {}, const DeafConfig& config = {}) {
  const auto echo = expected_echo(grid, T_map_sensor, radians(15.0), config, 0);
  return !echo ? Expectation::none : echo->is_certain ? Expectation::certain : Expectation::uncertain;
}

TEST(ExpectedEchoes, AWallThatFillsTheBeamIsCertainToEcho) {
  const auto echo = expected_echo(grid_with_wall(1.2), {}, radians(15.0), {}, 3);
  ASSERT_TRUE(echo);
  EXPECT_NEAR(echo->range_m, 1.2, 0.06);
  EXPECT_EQ(echo->sensor, 3);
  EXPECT_TRUE(echo->is_certain);
}

TEST(ExpectedEchoes, AWallFarAwayIsNotExpectedTo) {
  EXPECT_EQ(expected(grid_with_wall(2.3)), Expectation::none);
  EXPECT_EQ(expected(grid_with_wall(2.3), {}, {.within_m = 3.0}), Expectation::certain);
}

TEST(ExpectedEchoes, AWallSeenAtASlantIsUncertain) {
  EXPECT_EQ(expected(grid_with_wall(1.2, std::tan(radians(8.0)))), Expectation::certain);
  EXPECT_EQ(expected(grid_with_wall(1.2, std::tan(radians(25.0)))), Expectation::uncertain);
  EXPECT_EQ(expected(grid_with_wall(1.2), {0.0, 0.0, radians(30.0)}), Expectation::uncertain);
}

TEST(ExpectedEchoes, WhatFillsOnlyTheMiddleOfTheBeamIsUncertainAndWhatIsBesideItIsNotExpected) {
  OccupancyGrid post = grid_with_wall(3.5);
  for (int y = -4; y < 4; ++y) post.set_log_odds({24, y}, 800);
  EXPECT_EQ(expected(post), Expectation::uncertain);
  OccupancyGrid beside = grid_with_wall(3.5);
  for (int y = 2; y < 8; ++y) beside.set_log_odds({24, y}, 800);
  EXPECT_EQ(expected(beside), Expectation::none);
}

TEST(ExpectedEchoes, NothingIsExpectedBehindUnknownSpaceOrOfAWallThatIsUncertain) {
  OccupancyGrid hidden = grid_with_wall(1.2);
  for (int y = -20; y < 20; ++y)
    for (int x = 8; x < 14; ++x) hidden.set_log_odds({x, y}, 0);
  EXPECT_EQ(expected(hidden), Expectation::none);
  OccupancyGrid uncertain = grid_with_wall(1.2);
  for (int y = -20; y < 20; ++y)
    for (int x = 23; x < 28; ++x) uncertain.set_log_odds({x, y}, 200);
  EXPECT_EQ(expected(uncertain), Expectation::none);
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
