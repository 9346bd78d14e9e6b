#include "framework/modules/stage_clock.hpp"

#include <gtest/gtest.h>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

using namespace std::chrono_literals;

class StageClockTest : public testing::Test {
 protected:
  const std::shared_ptr<TestClock> time_ = std::make_shared<TestClock>();
  StageClock clock_{time_};
};

TEST_F(StageClockTest, CountsTheCallsOfEachModule) {
  const auto map = clock_.add("map", "bayes");
  const auto plan = clock_.add("planner", "hybrid");
  EXPECT_EQ(clock_.add("map", "bayes"), map);
  for (int i = 0; i < 99; ++i) {
    const StageClock::Visit visit(clock_, map);
    time_->advance(10us);
  }
  {
    const StageClock::Visit visit(clock_, map);
    time_->advance(5ms);
    const StageClock::Visit inner(clock_, plan);
  }
  const auto times = clock_.times();
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].module, "bayes");
  EXPECT_EQ(times[0].count, 100);
  EXPECT_NEAR(times[0].median_us, 10.0, 0.6);
  EXPECT_DOUBLE_EQ(times[0].worst_us, 5000.0);
  EXPECT_LE(times[0].p99_us, times[0].worst_us);
  EXPECT_DOUBLE_EQ(times[0].total_s, 99 * 10e-6 + 5e-3);
  EXPECT_EQ(times[1].count, 1);
}

TEST_F(StageClockTest, TheOwnTimesOfStagesSumToTheWhole) {
  const auto tick = clock_.add("tick", "");
  const auto host = clock_.add("behaviour tree", "");
  const auto step = clock_.add("behaviour", "goto");
  const auto plan = clock_.add("planner", "hybrid");
  for (int i = 0; i < 3; ++i) {
    const StageClock::Work whole(clock_, tick);
    {
      const StageClock::Work work(clock_, host);
      time_->advance(1ms);
      for (int k = 0; k < 2; ++k) {
        const StageClock::Visit visit(clock_, step);
        time_->advance(2ms);
        const StageClock::Visit planning(clock_, plan);
        time_->advance(10ms);
      }
      time_->advance(3ms);
    }
    time_->advance(5us);
  }
  const auto times = clock_.times();
  ASSERT_EQ(times.size(), 4U);
  EXPECT_DOUBLE_EQ(times[0].own_s, 3 * 5e-6) << "what no stage accounts for";
  EXPECT_DOUBLE_EQ(times[1].own_s, 3 * 4e-3);
  EXPECT_DOUBLE_EQ(times[2].own_s, 6 * 2e-3);
  EXPECT_DOUBLE_EQ(times[2].total_s, 6 * 12e-3);
  EXPECT_DOUBLE_EQ(times[3].own_s, 6 * 10e-3);
  double sum_s = 0.0;
  for (const StageTime& time : times) sum_s += time.own_s;
  EXPECT_NEAR(sum_s, times[0].total_s, 1e-12);
}

TEST_F(StageClockTest, WorkThatIsLeftOutCountsNowhere) {
  const auto tick = clock_.add("tick", "");
  const auto host = clock_.add("behaviour tree", "");
  {
    const StageClock::Work work(clock_, host);
    StageClock::Work whole(clock_, tick);
    time_->advance(1ms);
    whole.leave_out();
  }
  const auto times = clock_.times();
  ASSERT_EQ(times.size(), 1U);
  EXPECT_DOUBLE_EQ(times[0].own_s, 1e-3);
}

TEST_F(StageClockTest, TheHostsOwnWorkIsNeverGivenUp) {
  const StageClock::Work work(clock_, clock_.add("autosave", ""));
  time_->advance(10s);
  EXPECT_EQ(clock_.give_up_after(1ms), StageClock::kHost);
  EXPECT_NO_THROW(clock_.check());
}

TEST_F(StageClockTest, ACallThatLastsTooLongIsGivenUpOnceAndForAll) {
  const auto slow = clock_.add("map", "slow");
  EXPECT_EQ(clock_.give_up_after(0ns), StageClock::kHost) << "the host itself is never given up";
  {
    const StageClock::Visit visit(clock_, slow);
    time_->advance(1ms);
    EXPECT_EQ(clock_.give_up_after(1ms), StageClock::kHost) << "no longer than that";
    time_->advance(1ns);
    EXPECT_EQ(clock_.give_up_after(1ms), slow);
    EXPECT_EQ(clock_.give_up_after(1ms), StageClock::kHost) << "only once";
  }
  EXPECT_THROW(clock_.check(), GivenUp);
  EXPECT_THROW(const StageClock::Visit visit(clock_, slow), GivenUp);
}

TEST_F(StageClockTest, WhatAnInnerCallTookDoesNotCountAgainstTheOuterOne) {
  const auto outer = clock_.add("behaviour", "goto");
  const auto inner = clock_.add("planner", "hybrid");
  const StageClock::Visit visit(clock_, outer);
  {
    const StageClock::Visit planning(clock_, inner);
    time_->advance(30ms);
  }
  EXPECT_EQ(clock_.give_up_after(20ms), StageClock::kHost);
  time_->advance(21ms);
  EXPECT_EQ(clock_.give_up_after(20ms), outer);
}

}  // namespace
}  // namespace cairn
