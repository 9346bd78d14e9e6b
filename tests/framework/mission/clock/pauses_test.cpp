#include "framework/mission/clock/pauses.hpp"

#include <gtest/gtest.h>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

class PausesTest : public testing::Test {
 protected:
  ControlFlags flags_;
  RunControl control_{flags_, "held"};
  const std::shared_ptr<TestClock> clock_ = std::make_shared<TestClock>();
  Pauses pauses_{&control_, clock_};
};

TEST_F(PausesTest, NobodyPausesAMissionWithoutControl) {
  Pauses pauses(nullptr, clock_);
  EXPECT_FALSE(pauses.is_wanted());
  EXPECT_FALSE(pauses.apply(0.0).has_value());
}

TEST_F(PausesTest, SaysWhenAPauseBeginsAndHowLongItWas) {
  EXPECT_FALSE(pauses_.apply(0.0).has_value());
  flags_.pause = true;
  EXPECT_TRUE(std::holds_alternative<Paused>(pauses_.apply(2.0).value()));
  EXPECT_TRUE(pauses_.is_paused());
  EXPECT_FALSE(pauses_.apply(3.0).has_value()) << "only once";
  flags_.pause = false;
  EXPECT_EQ(std::get<Resumed>(pauses_.apply(5.0).value()).paused_s, 3.0);
  EXPECT_FALSE(pauses_.is_paused());
}

TEST_F(PausesTest, TheEndOfTheMissionEndsItsPause) {
  EXPECT_FALSE(pauses_.end(9.0).has_value());
  flags_.pause = true;
  (void)pauses_.apply(2.0);
  EXPECT_EQ(std::get<Resumed>(pauses_.end(9.0).value()).paused_s, 7.0);
}

TEST_F(PausesTest, ALogWaitsUntilItIsToGoOn) {
  flags_.pause = true;
  pauses_.hold();
  EXPECT_TRUE(pauses_.is_paused());
  int looks = 0;
  pauses_.wait({}, [&] {
    EXPECT_TRUE(pauses_.is_paused());
    if (++looks == 3) flags_.pause = false;
  });
  EXPECT_EQ(looks, 3);
  EXPECT_FALSE(pauses_.is_paused());
}

TEST_F(PausesTest, ALogThatIsCancelledWaitsNoLonger) {
  std::atomic<bool> cancel{false};
  Budget budget;
  budget.cancel = &cancel;
  flags_.pause = true;
  pauses_.hold();
  pauses_.wait(budget, [&] { cancel = true; });
  EXPECT_FALSE(pauses_.is_paused());
}

}  // namespace
}  // namespace cairn
