#include "framework/mission/clock/pace.hpp"

#include <gtest/gtest.h>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

class PaceTest : public testing::Test {
 protected:
  const std::shared_ptr<TestClock> clock_ = std::make_shared<TestClock>();
  const double begin_s_ = clock_->seconds();
  Pace pace_{clock_};
  [[nodiscard]] double passed_s() const { return clock_->seconds() - begin_s_; }
};

TEST_F(PaceTest, SleepsUntilAsMuchTimeHasPassedAsTheStampsSay) {
  pace_.keep(100.0, {});
  EXPECT_EQ(passed_s(), 0.0);
  pace_.keep(100.5, {});
  EXPECT_NEAR(passed_s(), 0.5, 1e-6);
  clock_->advance(std::chrono::milliseconds(300));
  pace_.keep(101.0, {});
  EXPECT_NEAR(passed_s(), 1.0, 1e-6) << "what the tick took counts";
}

TEST_F(PaceTest, AFactorDividesTheTime) {
  pace_.keep(100.0, {}, 4.0);
  pace_.keep(102.0, {}, 4.0);
  EXPECT_NEAR(passed_s(), 0.5, 1e-6);
  pace_.keep(103.0, {}, 1.0);
  EXPECT_NEAR(passed_s(), 0.5, 1e-6) << "another factor begins afresh";
  pace_.keep(104.0, {}, 1.0);
  EXPECT_NEAR(passed_s(), 1.5, 1e-6);
}

TEST_F(PaceTest, AMissionThatIsLateDoesNotSleep) {
  pace_.keep(0.0, {});
  clock_->advance(std::chrono::seconds(9));
  pace_.keep(5.0, {});
  EXPECT_NEAR(passed_s(), 9.0, 1e-9);
}

TEST_F(PaceTest, ReleasedItBeginsAfreshWithTheNextStamp) {
  pace_.keep(0.0, {});
  EXPECT_TRUE(pace_.is_kept());
  pace_.release();
  EXPECT_FALSE(pace_.is_kept());
  pace_.keep(1000.0, {});
  EXPECT_EQ(passed_s(), 0.0);
}

TEST_F(PaceTest, ACancelledMissionDoesNotSleep) {
  const std::atomic<bool> cancel{true};
  Budget budget;
  budget.cancel = &cancel;
  pace_.keep(0.0, {});
  pace_.keep(3600.0, budget);
  EXPECT_EQ(passed_s(), 0.0);
}

}  // namespace
}  // namespace cairn
