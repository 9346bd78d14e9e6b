#include "framework/mission/loop/hold_record.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(HoldRecord, SaysWhoStopsTheRobotOnceAndWhenItIsReleased) {
  HoldRecord holds;
  Observation observation;
  EXPECT_TRUE(holds.update(observation, 1.0).empty());
  observation.stopped_by = "the emergency topic /e_stop";
  const std::vector<Event> stopped = holds.update(observation, 2.0);
  ASSERT_EQ(stopped.size(), 1U);
  EXPECT_EQ(std::get<RobotStopped>(stopped[0]).by, "the emergency topic /e_stop");
  EXPECT_TRUE(holds.update(observation, 3.0).empty());
  observation.stopped_by.clear();
  const std::vector<Event> released = holds.update(observation, 5.5);
  ASSERT_EQ(released.size(), 1U);
  EXPECT_EQ(std::get<RobotReleased>(released[0]).stopped_s, 3.5);
}

TEST(HoldRecord, AnotherWhoStopsItIsSaidToo) {
  HoldRecord holds;
  Observation observation;
  observation.stopped_by = "one";
  (void)holds.update(observation, 1.0);
  observation.stopped_by = "another";
  const std::vector<Event> events = holds.update(observation, 2.0);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(std::get<RobotReleased>(events[0]).by, "one");
  EXPECT_EQ(std::get<RobotStopped>(events[1]).by, "another");
}

}  // namespace
}  // namespace cairn
