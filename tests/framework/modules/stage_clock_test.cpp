#include "framework/modules/stage_clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace cairn {
namespace {

using namespace std::chrono_literals;

TEST(StageClock, CountsTheCallsOfEachModule) {
  StageClock clock;
  const auto map = clock.add("map", "bayes");
  const auto plan = clock.add("planner", "hybrid");
  EXPECT_EQ(clock.add("map", "bayes"), map);
  for (int i = 0; i < 99; ++i) const StageClock::Visit visit(clock, map);
  {
    const StageClock::Visit visit(clock, map);
    std::this_thread::sleep_for(5ms);
    const StageClock::Visit inner(clock, plan);
  }
  const auto times = clock.times();
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].module, "bayes");
  EXPECT_EQ(times[0].count, 100);
  EXPECT_LT(times[0].median_us, 1000.0);
  EXPECT_GE(times[0].worst_us, 5000.0);
  EXPECT_LE(times[0].p99_us, times[0].worst_us);
  EXPECT_EQ(times[1].count, 1);
}

TEST(StageClock, ACallThatLastsTooLongIsGivenUpOnceAndForAll) {
  StageClock clock;
  const auto slow = clock.add("map", "slow");
  EXPECT_EQ(clock.give_up_after(0ns), StageClock::kHost) << "the host itself is never given up";
  {
    const StageClock::Visit visit(clock, slow);
    EXPECT_EQ(clock.give_up_after(1h), StageClock::kHost);
    std::this_thread::sleep_for(2ms);
    EXPECT_EQ(clock.give_up_after(1ms), slow);
    EXPECT_EQ(clock.give_up_after(1ms), StageClock::kHost) << "only once";
  }
  EXPECT_THROW(clock.check(), GivenUp);
  EXPECT_THROW(const StageClock::Visit visit(clock, slow), GivenUp);
}

TEST(StageClock, WhatAnInnerCallTookDoesNotCountAgainstTheOuterOne) {
  StageClock clock;
  const auto outer = clock.add("behaviour", "goto");
  const auto inner = clock.add("planner", "hybrid");
  const StageClock::Visit visit(clock, outer);
  {
    const StageClock::Visit planning(clock, inner);
    std::this_thread::sleep_for(30ms);
  }
  EXPECT_EQ(clock.give_up_after(20ms), StageClock::kHost);
}

}  // namespace
}  // namespace cairn
