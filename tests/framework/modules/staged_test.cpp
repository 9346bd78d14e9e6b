#include "framework/modules/staged.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cairn {
namespace {

struct Counter {
  int count = 0;
};

class StagedTest : public testing::Test {
 protected:
  StageClock clock_;
  const Staged<Counter> staged_{std::make_shared<Counter>(), clock_, clock_.add("map", "counter")};
};

TEST_F(StagedTest, ReturnsWhatTheCallReturnsAndCountsIt) {
  EXPECT_EQ(staged_.call([](Counter& counter) { return ++counter.count; }), 1);
  Counter& same = staged_.call([](Counter& counter) -> Counter& { return counter; });
  EXPECT_EQ(&same, &staged_.unwatched()) << "a reference stays one";
  EXPECT_EQ(clock_.times().at(0).count, 2);
}

TEST_F(StagedTest, WhatTheCallThrowsNamesModuleAndStage) {
  try {
    staged_.call([](Counter&) { throw std::runtime_error("full"); });
    FAIL() << "no fault";
  } catch (const ModuleFault& fault) {
    EXPECT_STREQ(fault.what(), "module counter failed in stage map: full");
  }
}

TEST_F(StagedTest, ACallThatComesBackAfterItWasGivenUpEndsTheMissionHoweverItComesBack) {
  const auto give_up = [&] { ASSERT_NE(clock_.give_up_after(std::chrono::nanoseconds(-1)), StageClock::kHost); };
  EXPECT_THROW(staged_.call([&](Counter&) {
    give_up();
    throw std::runtime_error("late");
  }),
               GivenUp);
  EXPECT_THROW(staged_.call([](Counter&) {}), GivenUp) << "and no other call begins";
}

TEST_F(StagedTest, APartOfTheModuleKeepsItAlive) {
  Staged<Counter> staged{std::make_shared<Counter>(), clock_, staged_.stage()};
  const std::weak_ptr<Counter> watched = staged.part(&staged.unwatched());
  const std::shared_ptr<int> part = staged.part(&staged.unwatched().count);
  staged = {};
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(staged_.part(static_cast<int*>(nullptr)), nullptr);
}

}  // namespace
}  // namespace cairn
