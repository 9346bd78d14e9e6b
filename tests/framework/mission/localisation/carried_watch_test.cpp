#include "framework/mission/localisation/carried_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

KnownLandmarks no_landmarks() {
  return {};
}

OccupancyGrid free_strip() {
  OccupancyGrid grid(0.05);
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 800; ++x) grid.set_log_odds({x, y}, log_odds_of(0.05));
  return grid;
}

TEST(MapSnapshots, TheOldestOfThreeIsSixToNineMetresOld) {
  MapSnapshots snapshots;
  for (double x_m = 0.0; x_m <= 30.0; x_m += 0.1) {
    if (!snapshots.drive({x_m, 0.0, 0.0})) continue;
    snapshots.add(std::make_shared<const MapSnapshot>(MapSnapshot{OccupancyGrid(0.05), {}, {x_m, 0.0, 0.0}}));
    if (x_m < 10.0) continue;
    EXPECT_NEAR(x_m - snapshots.oldest()->T_map_robot.x_m, 6.0, 0.3);
  }
  ASSERT_NE(snapshots.oldest(), nullptr);
  snapshots.clear();
  EXPECT_EQ(snapshots.oldest(), nullptr);
}

// Echoes in the open, all the way.
TEST(CarriedWatch, NothingIsKeptOfWhatIsDrawnWhileMuchContradictsTheMap) {
  const OccupancyGrid map = free_strip();
  RobotModel robot;
  robot.has_compass = false;
  CarriedWatch watch(robot);
  Observation seen;
  RangeReading echo;
  echo.max_m = 5.0;
  echo.range_m = 1.0;
  seen.ranges.assign(8, echo);
  std::optional<double> doubted_at_m;
  for (double x_m = 0.0; x_m < 12.0; x_m += 0.05) {
    seen.T_odom_robot = {x_m, 0.0, 0.0};
    watch.update(seen, seen.T_odom_robot, map, no_landmarks);
    if (!doubted_at_m && watch.doubt()) doubted_at_m = x_m;
  }
  ASSERT_TRUE(doubted_at_m);
  EXPECT_LT(*doubted_at_m, 2.5);
  EXPECT_DOUBLE_EQ(watch.before()->T_map_robot.x_m, 0.0) << "the only one from before";
  watch.keep_map();
  EXPECT_FALSE(watch.doubt()) << "it needs new evidence";
  EXPECT_NE(watch.before(), nullptr);
  watch.begin_anew();
  EXPECT_FALSE(watch.doubt());
  EXPECT_EQ(watch.before(), nullptr);
}

// Metres of echoes in the open until there is a doubt.
double metres_to_doubt(CarriedWatch& watch, const OccupancyGrid& map, double contradicted_ratio) {
  Observation seen;
  RangeReading echo;
  echo.max_m = 5.0;
  echo.range_m = 1.0;  // in the open
  RangeReading known = echo;
  known.T_robot_sensor.theta_rad = radians(90.0);
  known.range_m = 2.0;  // of the strip's edge
  const int against = static_cast<int>(std::lround(20.0 * contradicted_ratio));
  for (int i = 0; i < 20; ++i) seen.ranges.push_back(i < against ? echo : known);
  for (double x_m = 0.0; x_m < 12.0; x_m += 0.05) {
    seen.T_odom_robot = {x_m, 0.0, 0.0};
    watch.update(seen, seen.T_odom_robot, map, no_landmarks);
    if (watch.doubt()) return x_m;
  }
  return 1e9;
}

TEST(CarriedWatch, ADoubtNeedsNoMoreThanAtFirstWhenTheRobotWasFoundAgain) {
  OccupancyGrid map = free_strip();
  for (int x = -40; x < 800; ++x) map.set_log_odds({x, 40}, log_odds_of(0.95));
  RobotModel robot;
  robot.has_compass = false;
  CarriedWatch watch(robot);
  constexpr double kRatio = 0.2;
  EXPECT_LT(metres_to_doubt(watch, map, kRatio), 12.0);
  while (metres_to_doubt(watch, map, kRatio) < 12.0) watch.doubt_was_wrong();
  EXPECT_GT(metres_to_doubt(watch, map, kRatio), 12.0) << "doubts that were wrong raise what the next one needs";
  watch.begin_anew();
  EXPECT_LT(metres_to_doubt(watch, map, kRatio), 12.0);
}

TEST(CarriedWatch, ForgottenDoubtsAreCounted) {
  CarriedWatch watch(RobotModel{});
  for (int i = 0; i < 130; ++i) watch.record({static_cast<double>(i), DoubtCause::readings, PoseCheck{}});
  EXPECT_EQ(watch.figures().doubts.size(), 100U);
  EXPECT_EQ(watch.figures().doubts_left_out, 30U);
}

}  // namespace
}  // namespace cairn
