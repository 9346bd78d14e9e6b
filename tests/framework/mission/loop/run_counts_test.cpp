#include "framework/mission/loop/run_counts.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Observation at(double x_m, bool bumped = false, std::size_t readings = 0) {
  Observation observation;
  observation.T_odom_robot = {x_m, 0.0, 0.0};
  observation.bumped = bumped;
  observation.ranges.resize(readings);
  return observation;
}

TEST(RunCounts, AddsUpTheOdometryFromTheFirstObservationOn) {
  RunCounts counts;
  for (const double x_m : {5.0, 6.0, 4.5}) counts.count(at(x_m));
  EXPECT_DOUBLE_EQ(counts.figures().distance_m, 2.5);
}

TEST(RunCounts, ATouchCountsOnceHoweverLongItLasts) {
  RunCounts counts;
  EXPECT_FALSE(counts.count(at(0.0)));
  EXPECT_TRUE(counts.count(at(0.0, true)));
  EXPECT_FALSE(counts.count(at(0.0, true)));
  EXPECT_FALSE(counts.count(at(0.0)));
  EXPECT_TRUE(counts.count(at(0.0, true)));
  EXPECT_EQ(counts.figures().collisions, 2);
}

TEST(RunCounts, GoOnFromThoseOfAnEarlierRun) {
  RunCounts counts;
  counts.restore({100, 7, 1, 20.0});
  counts.count(at(3.0, false, 4));
  counts.count_matchings(2);
  EXPECT_EQ(counts.figures().readings, 104);
  EXPECT_EQ(counts.figures().matchings, 9);
  EXPECT_EQ(counts.figures().collisions, 1);
  EXPECT_EQ(counts.figures().distance_m, 20.0);
}

}  // namespace
}  // namespace cairn
