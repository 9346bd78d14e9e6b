#include "framework/mission/clock/mission_clock.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(MissionClock, BeginsAtZeroWithTheFirstStampWhateverItIs) {
  MissionClock clock;
  EXPECT_FALSE(clock.has_begun());
  EXPECT_EQ(clock.advance(100.5, false), 0.0);
  EXPECT_TRUE(clock.has_begun());
  EXPECT_EQ(clock.advance(101.0, false), 0.5);
  EXPECT_EQ(clock.time_s(), 0.5);
}

TEST(MissionClock, StandsWhileTheMissionIsPaused) {
  MissionClock clock;
  clock.advance(10.0, false);
  clock.advance(11.0, false);
  EXPECT_EQ(clock.advance(15.0, true), 1.0);
  EXPECT_EQ(clock.paused_s(), 4.0);
  EXPECT_EQ(clock.advance(16.0, false), 2.0);
  EXPECT_EQ(clock.paused_s(), 4.0);
}

TEST(MissionClock, GoesOnFromASavedMapWithTheFirstStamp) {
  MissionClock clock;
  EXPECT_FALSE(clock.resumed_s().has_value());
  clock.restore(30.0, 7.0);
  EXPECT_EQ(clock.time_s(), 30.0);
  EXPECT_EQ(clock.resumed_s(), 30.0);
  EXPECT_EQ(clock.advance(200.0, false), 30.0);
  EXPECT_EQ(clock.advance(201.0, true), 30.0);
  EXPECT_EQ(clock.paused_s(), 8.0);
}

TEST(MissionClock, ALogThatIsReadOnceMoreHasItsTimesAgain) {
  MissionClock clock;
  clock.restore(2.0, 0.0);
  EXPECT_EQ(clock.replay(50.0), 0.0);
  EXPECT_EQ(clock.replay(52.0), 2.0);
  EXPECT_FALSE(clock.has_begun());
  EXPECT_EQ(clock.advance(53.0, false), 3.0);
}

}  // namespace
}  // namespace cairn
