#include "framework/mission/perception/past.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn {
namespace {

Observation scan(double stamp_s, std::vector<double> ranges_m, double max_m = 8.0) {
  Observation seen;
  seen.stamp_s = stamp_s;
  for (const double range_m : ranges_m)
    seen.ranges.push_back({{0.1, 0.0, 0.2 * static_cast<double>(seen.ranges.size())}, 0.0, 0.05, max_m, range_m, 3});
  return seen;
}

TEST(Past, KeepsWhatTheMapNeedsOfEachObservation) {
  const double infinity = std::numeric_limits<double>::infinity();
  Past past(true);
  past.add(scan(1.0, {1.5, infinity}), {1.0, 0.0, 0.0});
  past.add(scan(2.0, {2.5, -infinity}), {2.0, 0.0, 0.0});
  past.add(scan(3.0, {3.5}, 4.0), {3.0, 0.0, 0.0});
  ASSERT_EQ(past.size(), 3U);
  const Observation second = past.observation(1);
  EXPECT_EQ(second.stamp_s, 2.0);
  ASSERT_EQ(second.ranges.size(), 2U);
  EXPECT_EQ(second.ranges[0].range_m, 2.5);
  EXPECT_EQ(second.ranges[1].range_m, -infinity);
  EXPECT_EQ(second.ranges[1].T_robot_sensor, (Pose2{0.1, 0.0, 0.2}));
  EXPECT_EQ(second.ranges[1].sensor, 3);
  EXPECT_EQ(past.observation(2).ranges.size(), 1U);
  EXPECT_EQ(past.observation(2).ranges[0].max_m, 4.0) << "a scan with other transducers";
}

TEST(Past, PosesHaveTheStampsOfTheLogWhereThereIsOne) {
  Past past;
  Observation seen = scan(1.0, {});
  past.add(seen, {});
  seen.recorded_s = 976052890.25;
  past.add(seen, {});
  EXPECT_EQ(past.poses()[0].stamp_s, 1.0);
  EXPECT_EQ(past.poses()[1].stamp_s, 976052890.25);
}

TEST(Past, ACorrectionIsAsLongAsTheLongestMoveOfAPose) {
  Past past;
  past.add(scan(1.0, {}), {0.0, 0.0, 0.0});
  past.add(scan(2.0, {}), {1.0, 0.0, 0.0});
  const std::vector<Pose2> corrected = {{0.0, 0.0, 0.0}, {1.3, 0.4, 0.0}};
  EXPECT_NEAR(past.moved_m(corrected), 0.5, 1e-12);
  past.correct(corrected);
  EXPECT_EQ(past.moved_m(corrected), 0.0);
  EXPECT_EQ(past.poses()[1].T_map_robot, corrected[1]);
}

}  // namespace
}  // namespace cairn
