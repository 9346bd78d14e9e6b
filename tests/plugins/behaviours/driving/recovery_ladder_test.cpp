#include "plugins/behaviours/driving/recovery_ladder.hpp"

#include <gtest/gtest.h>

namespace cairn::behaviours {
namespace {

const Point kHere{1.0, 1.0};
const std::optional<Point> kSomething = Point{1.5, 1.0};

TEST(RecoveryLadder, TriesOneRecoveryAfterTheOtherAtOnePlaceAndGivesUp) {
  RecoveryLadder ladder({}, 4);
  EXPECT_EQ(ladder.next(kHere, kSomething), Recovery::back_up_and_turn);
  EXPECT_EQ(ladder.next(kHere, kSomething), Recovery::back_up_and_look);
  EXPECT_EQ(ladder.next(kHere, kSomething), Recovery::yield);
  EXPECT_EQ(ladder.without_yielding(), Recovery::back_up_and_turn) << "where there is nowhere to go";
  EXPECT_EQ(ladder.next(kHere, kSomething), Recovery::back_up_and_look);
  EXPECT_EQ(ladder.next(kHere, kSomething), Recovery::give_up);
}

TEST(RecoveryLadder, ABlockageElsewhereBeginsItAnew) {
  RecoveryLadder ladder({}, 6);
  (void)ladder.next(kHere, kSomething);
  (void)ladder.next(kHere, kSomething);
  EXPECT_EQ(ladder.next(kHere + Point(2.0, 0.0), kSomething), Recovery::back_up_and_turn);
  EXPECT_EQ(ladder.round(), 1);
}

TEST(RecoveryLadder, ThereIsNothingToLookAtWhereNothingIsKnownToBlockTheRobot) {
  RecoveryLadder ladder({}, 6);
  (void)ladder.next(kHere, std::nullopt);
  EXPECT_EQ(ladder.next(kHere, std::nullopt), Recovery::back_up_and_turn);
}

TEST(RecoveryLadder, GivesUpAfterTooManyBlockagesInAll) {
  RecoverySettings settings;
  settings.max_blockages = 3;
  RecoveryLadder ladder(settings, 6);
  for (int i = 0; i < 3; ++i) EXPECT_NE(ladder.next({5.0 * i, 0.0}, kSomething), Recovery::give_up);
  EXPECT_EQ(ladder.next({50.0, 0.0}, kSomething), Recovery::give_up);
}

TEST(RecoveryLadder, BacksUpFartherRoundAfterRound) {
  RecoveryLadder ladder({}, 9);
  for (const int times : {1, 2, 3, 3, 3}) {
    (void)ladder.next(kHere, kSomething);
    EXPECT_EQ(ladder.back_up_times(), times);
  }
}

TEST(BackUp, EndsWhenItIsFarEnoughLateOrSomethingIsBehind) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  bool is_blocked = false;
  const auto tick = [&](const BackUp& back_up, double x_m, double time_s) {
    const WorldView world{grid, graph, robot, {{x_m, 0.0, 0.0}, {}}, time_s};
    return back_up.tick(world, [&](const std::vector<Point>&, double, double) { return is_blocked; });
  };
  BackUp back_up({.speed_mps = 0.04, .distance_m = 0.2, .at_most_s = 6.0});
  back_up.begin({grid, graph, robot, {}, 10.0}, 2);
  ASSERT_TRUE(tick(back_up, -0.3, 15.0));
  EXPECT_EQ(tick(back_up, -0.3, 15.0)->v_mps, -0.04);
  EXPECT_FALSE(tick(back_up, -0.41, 15.0)) << "twice as far";
  EXPECT_FALSE(tick(back_up, 0.0, 22.5)) << "twice as long";
  is_blocked = true;
  EXPECT_FALSE(tick(back_up, -0.1, 12.0));
}

}  // namespace
}  // namespace cairn::behaviours
