#include "framework/mission/autosave.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

using namespace std::chrono_literals;

class AutosaverTest : public testing::Test {
 protected:
  AutosaverTest() { std::filesystem::create_directories(folder_); }
  ~AutosaverTest() override { std::filesystem::remove_all(folder_); }

  static SavedMap map_at(double time_s) {
    SavedMap map;
    map.progress = MissionProgress{.time_s = time_s};
    return map;
  }
  // What has come of the copy, once it is written.
  static Autosaver::Outcome outcome_of(Autosaver& autosaver) {
    while (true) {
      if (auto outcome = autosaver.last_outcome()) return *outcome;
      std::this_thread::yield();
    }
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_autosave_" + std::to_string(getpid()) + "_" +
                                                   testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::filesystem::path file_ = folder_ / "a.autosave.cairn";
  const std::shared_ptr<TestClock> clock_ = std::make_shared<TestClock>();
};

TEST_F(AutosaverTest, IsNeverDueWithoutAnInterval) {
  Autosaver autosaver(file_, 0.0, clock_);
  EXPECT_FALSE(autosaver.is_due());
  clock_->advance(1h);
  EXPECT_FALSE(autosaver.is_due());
}

TEST_F(AutosaverTest, IsDueAtOnceAndThenWhenTheIntervalIsOver) {
  Autosaver autosaver(file_, 30.0, clock_);
  EXPECT_TRUE(autosaver.is_due());
  autosaver.save(map_at(1.0), clock_->now());
  EXPECT_TRUE(outcome_of(autosaver).saved);
  EXPECT_FALSE(autosaver.is_due());
  for (int second = 1; second < 29; ++second) {
    clock_->advance(1s);
    EXPECT_FALSE(autosaver.is_due()) << second;
  }
  clock_->advance(1s);
  EXPECT_TRUE(autosaver.is_due()) << "as early as a tick is long, so that it is over in time";
}

TEST_F(AutosaverTest, WritesTheCopyAndSaysWhatItHolds) {
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(12.5), clock_->now());
  const Autosaver::Outcome outcome = outcome_of(autosaver);
  EXPECT_TRUE(outcome.saved);
  EXPECT_EQ(outcome.time_s, 12.5);
  EXPECT_EQ(load_map(file_).progress->time_s, 12.5);
  EXPECT_EQ(autosaver.figures().saved, 1);
  EXPECT_EQ(autosaver.figures().last_time_s, 12.5);
  EXPECT_FALSE(autosaver.last_outcome()) << "once";
}

TEST_F(AutosaverTest, FinishWaitsForWhatIsBeingWritten) {
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(3.0), clock_->now());
  autosaver.finish();
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_EQ(autosaver.figures().saved, 1);
}

TEST_F(AutosaverTest, AFileThatCannotBeWrittenIsCountedWithTheFirstReason) {
  std::filesystem::create_directories(file_);
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(3.0), clock_->now());
  const Autosaver::Outcome outcome = outcome_of(autosaver);
  EXPECT_FALSE(outcome.saved);
  EXPECT_FALSE(outcome.reason.empty());
  EXPECT_EQ(autosaver.figures().failed, 1);
  EXPECT_EQ(autosaver.figures().failure, outcome.reason);
}

TEST_F(AutosaverTest, AnEarlierAutosaveIsKeptUnderTheNextFreeName) {
  EXPECT_FALSE(keep_earlier_autosave(file_));
  std::ofstream(folder_ / "a.autosave.1.cairn") << "taken";
  std::ofstream(file_) << "earlier";
  EXPECT_EQ(keep_earlier_autosave(file_), folder_ / "a.autosave.2.cairn");
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace cairn
