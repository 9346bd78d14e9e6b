#include "framework/mission/held_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RangeReading reading_of(double range_m, double half_beam_rad = radians(15.0)) {
  return {{}, half_beam_rad, 0.1, 4.0, range_m, 0};
}

// Free up to a wall across the beam at x = 2 m.
OccupancyGrid wall_at_two_metres() {
  OccupancyGrid grid(0.05, 4.0);
  for (int y = -40; y < 40; ++y)
    for (int x = 0; x < 40; ++x) grid.set_log_odds({x, y}, -1024);
  for (int y = -40; y < 40; ++y) grid.set_log_odds({40, y}, 1024);
  return grid;
}

TEST(HoldOut, SeedsInARowHoldOutEachReadingOnce) {
  std::vector<int> times(20, 0);
  for (std::int64_t seed = 7; seed < 12; ++seed) {
    HoldOut withholding(5, seed);
    for (int& count : times) count += withholding.next() ? 1 : 0;
  }
  EXPECT_EQ(times, std::vector<int>(20, 1));
}

TEST(HoldOut, ZeroHoldsOutNothing) {
  HoldOut withholding(0, 3);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(withholding.next());
}

TEST(LogLikelihood, AReadingOfTheWallIsForetoldBestOfAll) {
  const OccupancyGrid grid = wall_at_two_metres();
  const double of_wall = log_likelihood(grid, {}, reading_of(2.02));
  for (const double other_m : {0.5, 1.0, 1.5, 1.8, 2.4, 3.0, 3.9})
    EXPECT_GT(of_wall, log_likelihood(grid, {}, reading_of(other_m)) + 1.0) << other_m;
}

TEST(LogLikelihood, WithoutAnEchoAnEmptyMapIsTheLikelier) {
  EXPECT_GT(log_likelihood(OccupancyGrid(0.05), {}, reading_of(kInfinity)),
            log_likelihood(wall_at_two_metres(), {}, reading_of(kInfinity)) + 0.5);
}

// Echoes and their absence are all that can happen: the whole chance is 1.
TEST(LogLikelihood, ChancesAddUpToOne) {
  for (const double half_beam_rad : {radians(15.0), 0.0}) {
    const OccupancyGrid grid = wall_at_two_metres();
    double sum = std::exp(log_likelihood(grid, {}, reading_of(kInfinity, half_beam_rad)));
    constexpr double kStep_m = 0.005;
    for (double range_m = 0.5 * kStep_m; range_m < 4.0; range_m += kStep_m)
      sum += kStep_m * std::exp(log_likelihood(grid, {}, reading_of(range_m, half_beam_rad)));
    EXPECT_NEAR(sum, 1.0, 0.01) << half_beam_rad;
  }
}

TEST(HeldOutReadings, LeavesOutWhatSaysNothing) {
  Observation observation;
  for (const double range_m : {1.0, kInfinity, -kInfinity, std::nan(""), 9.0, 2.0})
    observation.ranges.push_back(reading_of(range_m));
  const OccupancyGrid grid = wall_at_two_metres();
  const LandmarkGraph graph;
  const RobotModel robot;
  const WorldView world{grid, graph, robot, {}, 0.0, &observation, 0.0};
  HeldOutReadings held_out(1, 1);
  held_out.on(TickDone{}, {world});
  EXPECT_EQ(held_out.count(), 4);
  EXPECT_NEAR(held_out.mean_log_likelihood(grid),
              (log_likelihood(grid, {}, reading_of(1.0)) + 2.0 * log_likelihood(grid, {}, reading_of(kInfinity)) +
               log_likelihood(grid, {}, reading_of(2.0))) /
                  4.0,
              1e-12);
}

}  // namespace
}  // namespace cairn
