#include "framework/reporting/event_log.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

EventLog log_of(int count, std::size_t max_events) {
  EventLog log(max_events);
  for (int i = 1; i <= count; ++i) log.add(std::to_string(i));
  return log;
}

TEST(EventLog, HoldsAllUpToItsBound) {
  EXPECT_THAT(log_of(0, 4).sentences(), IsEmpty());
  EXPECT_THAT(log_of(3, 4).sentences(), ElementsAre("1", "2", "3"));
  EXPECT_THAT(log_of(4, 4).sentences(), ElementsAre("1", "2", "3", "4"));
  EXPECT_EQ(log_of(4, 4).left_out(), 0);
}

TEST(EventLog, HoldsTheFirstAndTheLastOfMore) {
  EXPECT_THAT(log_of(9, 4).sentences(), ElementsAre("1", "2", "8", "9"));
  EXPECT_EQ(log_of(9, 4).left_out(), 5);
  EXPECT_THAT(log_of(9, 5).sentences(), ElementsAre("1", "2", "3", "8", "9"));
  EXPECT_THAT(log_of(9, 1).sentences(), ElementsAre("1"));
}

}  // namespace
}  // namespace cairn
