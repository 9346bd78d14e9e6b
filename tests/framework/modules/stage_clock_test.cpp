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
