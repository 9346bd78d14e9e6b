#include "framework/program/common/making_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "framework/modules/making.hpp"

namespace cairn {
namespace {

using namespace std::chrono_literals;

// What a watch says first; the real one has ended the program by then.
class Said {
 public:
  struct End {
    std::string sentence;
    bool is_cancelled = false;
  };

  MakingWatch::End note() {
    return [this](const std::string& sentence, bool is_cancelled) {
      std::call_once(once_, [&] { first_.set_value({sentence, is_cancelled}); });
    };
  }
  std::optional<End> within(std::chrono::milliseconds time) {
    if (future_.wait_for(time) != std::future_status::ready) return std::nullopt;
    return future_.get();
  }

 private:
  std::once_flag once_;
  std::promise<End> first_;
  std::future<End> future_ = first_.get_future();
};

const std::atomic<bool> kNever = false;

TEST(MakingWatch, GivesUpAModuleThatIsNotMadeInTime) {
  Said said;
  const ModuleMaking slow("slow");
  const MakingWatch watch({0.1, kNever}, said.note());
  const auto end = said.within(10s);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->sentence, "module slow has not been made within 0.1 s and was given up");
  EXPECT_FALSE(end->is_cancelled);
}

TEST(MakingWatch, LeavesThoseAloneThatMayTakeLong) {
  Said said;
  const ModuleMaking sensor("sensor", true);
  const MakingWatch watch({0.05, kNever}, said.note());
  EXPECT_FALSE(said.within(300ms));
}

TEST(MakingWatch, WithoutALimitNobodyIsGivenUp) {
  Said said;
  const ModuleMaking slow("slow");
  const MakingWatch watch({0.0, kNever}, said.note());
  EXPECT_FALSE(said.within(300ms));
}

TEST(MakingWatch, CancelledItGivesWhateverIsBeingMadeTwoSeconds) {
  Said said;
  std::atomic<bool> is_cancelled = true;
  const ModuleMaking sensor("sensor", true);
  const MakingWatch watch({0.0, is_cancelled}, said.note());
  EXPECT_FALSE(said.within(1500ms));
  const auto end = said.within(10s);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->sentence, "module sensor was still being made");
  EXPECT_TRUE(end->is_cancelled);
}

TEST(MakingWatch, AWatchdogOfAFewSecondsIsNoLimitForPackagesAndNets) {
  EXPECT_EQ(max_making_s(0.0), 0.0);
  EXPECT_EQ(max_making_s(3.0), 10.0);
  EXPECT_EQ(max_making_s(30.0), 30.0);
}

// The calls of a command that makes a module which is never made.
[[noreturn]] void make_for_ever(double max_s, bool is_cancelled) {
  const std::atomic<bool> cancel = is_cancelled;
  const MakingWatch watch = watch_making(max_s, cancel);
  const ModuleMaking endless("endless");
  for (;;) std::this_thread::sleep_for(1s);
}

TEST(MakingWatchDeathTest, EndsACommandWithOneLineAndItsStatus) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(make_for_ever(0.1, false), testing::ExitedWithCode(2),
              "^cairn: module endless has not been made within 0.1 s and was given up\n$");
  EXPECT_EXIT(make_for_ever(0.0, true), testing::ExitedWithCode(1), "^cairn: module endless was still being made\n$");
}

}  // namespace
}  // namespace cairn
