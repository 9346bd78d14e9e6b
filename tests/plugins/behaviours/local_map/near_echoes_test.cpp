#include "plugins/behaviours/local_map/near_echoes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn::behaviours {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Observation echo_at(double range_m, int sensor = 0) {
  Observation observation;
  observation.ranges = {{{0.1, 0.0, 0.0}, radians(15.0), 0.1, 5.0, range_m, sensor}};
  return observation;
}

// Sideways along a wall at x = 1.02, looking at it; the sonar is 0.52 m from it.
void pass_wall(NearEchoes& echoes, double range_m = 0.52) {
  for (double y = 0.0; y < 1.0; y += 0.02) echoes.see(echo_at(range_m), {0.4, y, 0.0});
}

TEST(NearEchoes, AWallThatWasPassedIsSolidAndTheWayToItFree) {
  const OccupancyGrid map(0.05);
  NearEchoes echoes(map);
  pass_wall(echoes);
  pass_wall(echoes);
  for (double y = 0.1; y < 0.9; y += 0.05) {
    EXPECT_TRUE(echoes.is_solid(map.cell_at({1.01, y}))) << y;
    EXPECT_TRUE(echoes.is_conservatively_free(map.cell_at({0.7, y}))) << y;
  }
}

TEST(NearEchoes, AScanVotesOnceForACellHoweverManyBeamsCrossIt) {
  const OccupancyGrid map(0.05);
  const auto solid_after = [&](int beams, int scans) {
    NearEchoes echoes(map);
    for (int k = 0; k < scans; ++k) {
      Observation seen;
      for (int i = 0; i < beams; ++i)
        seen.ranges.push_back({{0.0, 0.0, radians(10.0) * (2.0 * i / (beams - 1) - 1.0)}, 0.0, 0.05, 8.0, 0.62, i});
      echoes.see(seen, {0.4, 0.025 + 0.03 * k, 0.0});
    }
    return echoes.is_solid(map.cell_at({1.02, 0.025}));
  };
  EXPECT_FALSE(solid_after(1001, 1)) << "one scan is one look";
  EXPECT_TRUE(solid_after(1001, 2));
  EXPECT_TRUE(solid_after(21, 2));
}

TEST(NearEchoes, AnEchoOutvotesBeamsOfTheSameScanThatPassIt) {
  const OccupancyGrid map(0.05);
  NearEchoes echoes(map);
  for (int k = 0; k < 4; ++k) {
    Observation seen;  // a thin post before a wall
    for (int i = 0; i < 181; ++i)
      seen.ranges.push_back({{0.0, 0.0, radians(0.25 * (i - 90))}, 0.0, 0.05, 8.0, i == 90 - 16 * k ? 0.62 : 0.95, i});
    echoes.see(seen, {0.4, 0.025, radians(4.0 * k)});
  }
  EXPECT_TRUE(echoes.is_solid(map.cell_at({1.02, 0.025})));
}

TEST(NearEchoes, LongReadingsAndSilenceDoNotWipeItOut) {
  const OccupancyGrid map(0.05);
  NearEchoes echoes(map);
  pass_wall(echoes);
  for (int i = 0; i < 20; ++i) {
    pass_wall(echoes, 3.0);
    pass_wall(echoes, kInfinity);
    pass_wall(echoes, std::numeric_limits<double>::quiet_NaN());
    pass_wall(echoes, -kInfinity);
  }
  EXPECT_TRUE(echoes.is_solid(map.cell_at({1.01, 0.5})));
}

// Facing an opening at 0.7 m, sweeping.
void face_opening(NearEchoes& echoes, double range_m) {
  for (int i = 0; i < 12; ++i) echoes.see_through(echo_at(range_m), {0.0, 0.0, radians(i % 2 == 0 ? 2.0 : -2.0)}, 1.1);
}

TEST(NearEchoes, AnOpeningThatIsFacedIsFreeWhenEchoesComeFromFarBehindIt) {
  OccupancyGrid map(0.05);
  map.set_log_odds(map.cell_at({0.7, 0.0}), 400);
  NearEchoes echoes(map);
  face_opening(echoes, 3.0);
  EXPECT_FALSE(echoes.is_occupied(map, map.cell_at({0.7, 0.0})));
  EXPECT_FALSE(echoes.is_conservatively_free(map.cell_at({1.4, 0.0}))) << "beyond what was asked about";
}

TEST(NearEchoes, SilenceAndNearEchoesDoNotOpenAnything) {
  OccupancyGrid map(0.05);
  map.set_log_odds(map.cell_at({0.7, 0.0}), 400);
  for (const double range_m : {5.0, kInfinity, std::numeric_limits<double>::quiet_NaN(), 0.9, 0.0}) {
    NearEchoes echoes(map);
    face_opening(echoes, range_m);
    EXPECT_TRUE(echoes.is_occupied(map, map.cell_at({0.7, 0.0}))) << range_m;
  }
}

TEST(NearEchoes, EchoesFromBehindDo) {
  const OccupancyGrid map(0.05);
  NearEchoes echoes(map);
  pass_wall(echoes);
  for (int i = 0; i < 4; ++i) pass_wall(echoes, 0.9);
  EXPECT_FALSE(echoes.is_solid(map.cell_at({1.01, 0.5})));
}

TEST(NearEchoes, ARobotThatStandsStillVotesOnce) {
  const OccupancyGrid map(0.05);
  NearEchoes echoes(map);
  for (int i = 0; i < 1000; ++i) echoes.see(echo_at(0.52), {0.4, 0.5, 0.0});
  EXPECT_FALSE(echoes.is_solid(map.cell_at({1.01, 0.5})));
}

TEST(NearEchoes, OutvotesTheMapBothWays) {
  OccupancyGrid map(0.05);
  const Cell ghost = map.cell_at({0.7, 0.5});
  const Cell wiped_out = map.cell_at({1.01, 0.5});
  const Cell elsewhere = map.cell_at({2.0, 2.0});
  map.set_log_odds(ghost, 800);
  map.set_log_odds(wiped_out, -800);
  map.set_log_odds(elsewhere, 800);
  NearEchoes echoes(map);
  pass_wall(echoes);
  pass_wall(echoes);
  const OccupancyGrid result = echoes.applied_to(map, map.bounds().grown(10));
  EXPECT_EQ(result.state(ghost), CellState::free);
  EXPECT_EQ(result.state(wiped_out), CellState::occupied);
  EXPECT_EQ(result.log_odds(elsewhere), map.log_odds(elsewhere));
  for (const Cell cell : {ghost, wiped_out, elsewhere})
    EXPECT_EQ(echoes.is_occupied(map, cell), result.state(cell) == CellState::occupied);
}

TEST(NearEchoes, WhereTheRobotHasStoodIsFree) {
  OccupancyGrid map(0.05);
  map.set_log_odds(map.cell_at({0.5, 0.5}), 800);
  NearEchoes echoes(map);
  echoes.stand_at({0.5, 0.4}, 0.22);
  EXPECT_FALSE(echoes.is_occupied(map, map.cell_at({0.5, 0.5})));
  EXPECT_FALSE(echoes.is_conservatively_free(map.cell_at({0.5, 0.8})));
}

TEST(NearEchoes, GivesTheAskedPartOfTheMapOnly) {
  OccupancyGrid map(0.05);
  map.set_log_odds({0, 0}, 800);
  map.set_log_odds({40, 40}, 800);
  const OccupancyGrid part = NearEchoes(map).applied_to(map, {{-5, -5}, {5, 5}});
  EXPECT_EQ(part.state({0, 0}), CellState::occupied);
  EXPECT_EQ(part.state({40, 40}), CellState::unknown);
}

}  // namespace
}  // namespace cairn::behaviours
