#include "plugins/behaviours/driving/blockage_look.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn::behaviours {
namespace {

// A robot at the origin looks ahead at something 1 m away.
struct Looking : testing::Test {
  Looking() : grid(0.05) {
    at = grid.centre_of(grid.cell_at({1.0, 0.0}));
    grid.set_log_odds(grid.cell_at(at), 600);
    look.aim_at(look.target_at(at));
  }
  // One tick with an echo from this range.
  bool has_opened(double range_m) {
    Observation seen;
    seen.ranges = {{{0.0, 0.0, 0.0}, radians(15.0), 0.1, 5.0, range_m, 0}};
    time_s += 0.04;
    const WorldView world{grid, graph, robot, {}, time_s, &seen};
    const NearEchoes echoes(grid);
    obstacles.see(world, echoes);
    return look.has_opened(world, echoes, obstacles);
  }
  OccupancyGrid grid;
  LandmarkGraph graph;
  RobotModel robot;
  BlockageLook look;
  LocalObstacles obstacles;
  Point at;
  double time_s = 0.0;
};

TEST_F(Looking, WhatBlockedTheRobotHasGoneWhenEchoesComeFromBehindItForSomeTicks) {
  BlockageLook::Target live = look.target_at(at);
  live.is_live = true;
  look.aim_at(live);
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(has_opened(2.0)) << i;
  EXPECT_TRUE(has_opened(2.0));
  EXPECT_TRUE(look.doubts().gone.contains(grid.cell_at(at)));
}

TEST_F(Looking, SilenceSaysNothing) {
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(has_opened(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(look.doubts().gone.contains(grid.cell_at(at)));
}

TEST_F(Looking, OneCellIsNoDoor) {
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(has_opened(2.0)) << "the map holds it, and it is not a door's width";
  EXPECT_EQ(look.doubts().seen_through.size(), 1U);
}

TEST_F(Looking, AnotherTargetForgetsWhatWasSeen) {
  for (int i = 0; i < 30; ++i) (void)has_opened(2.0);
  look.aim_at(look.target_at({3.0, 0.0}));
  EXPECT_TRUE(look.doubts().seen_through.empty());
}

TEST_F(Looking, AllIsLookedAtOnceMoreFromNearer) {
  const double first_m = look.stand_off_m();
  for (int i = 0; i < 6; ++i) {
    look.count_drive();
    look.remember_looked_at({1.0 * i, 0.0});
  }
  EXPECT_LT(look.stand_off_m(), first_m);
  EXPECT_EQ(look.looked_at().size(), 6U);
  look.count_drive();
  EXPECT_TRUE(look.looked_at().empty());
  for (int i = 0; i < 5; ++i) look.count_drive();
  EXPECT_FALSE(look.may_drive_to_look());
}

}  // namespace
}  // namespace cairn::behaviours
