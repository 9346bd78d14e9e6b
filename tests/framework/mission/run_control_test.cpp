// A running mission that is paused, asked and cancelled by another thread.

#include "framework/mission/run_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "tests/framework/mission/still_modules.hpp"
#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

class MissionControl : public testing::Test {
 protected:
  MissionControl() : folder_(std::filesystem::path(testing::TempDir()) / ("cairn_held_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    still::on_command = [this](const Twist& twist) { commands_.push_back(twist.v_mps); };
  }
  ~MissionControl() override {
    still::sees_ahead = false;
    still::on_tick = nullptr;
    still::on_command = nullptr;
    std::filesystem::remove_all(folder_);
  }
  MissionResult run(int ticks, std::function<void(int)> on_tick) {
    still::sees_ahead = true;
    still::on_tick = std::move(on_tick);
    RunOptions options{folder_};
    options.cancel = &flags_.cancel;
    options.control = &control_;
    options.wall_clock = std::make_shared<TestClock>();
    MissionRunner runner(still::mission(ticks), library_, options);
    return runner.run();
  }

  std::filesystem::path folder_;
  ModuleLibrary library_ = still::library();
  ControlFlags flags_;
  RunControl control_{flags_, "still"};
  std::vector<double> commands_;
};

TEST_F(MissionControl, APauseStopsTheRobotInTheSameTickAndItsClockStands) {
  const MissionResult result = run(20, [&](int tick) {
    if (tick == 5) flags_.pause = true;
    if (tick == 10) flags_.pause = false;
  });
  ASSERT_GE(commands_.size(), 20U);
  for (int tick = 0; tick < 20; ++tick)
    EXPECT_EQ(commands_[static_cast<std::size_t>(tick)], tick >= 5 && tick < 10 ? 0.0 : 0.1) << "tick " << tick;
  EXPECT_NEAR(result.paused_s, 5 * 0.04, 1e-9);
  EXPECT_NEAR(result.time_s, (19 - 5) * 0.04, 1e-9);
}

TEST_F(MissionControl, APausedMissionIsCancelledAndSaysHowItStood) {
  flags_.pause = true;
  RunStatus paused;
  RunStatus ended;
  std::thread asker([&] {
    paused = control_.status_in(RunState::paused, std::chrono::seconds(20));
    flags_.cancel = true;
    ended = control_.status_in(RunState::ended, std::chrono::seconds(20));
  });
  const MissionResult result = run(1000000000, nullptr);
  asker.join();
  EXPECT_EQ(result.outcome, MissionOutcome::cancelled);
  EXPECT_EQ(paused.state, RunState::paused);
  EXPECT_EQ(paused.mission, "still");
  EXPECT_EQ(paused.steps, 1U);
  EXPECT_EQ(ended.outcome, "cancelled");
  EXPECT_EQ(ended.map_file, "still.cairn");
  EXPECT_EQ(result.time_s, 0.0);
}

TEST(RunControl, BeforeTheMissionStartsAndAfterItsEndTheLastStatusIsTheAnswerAtOnce) {
  ControlFlags flags;
  RunControl control(flags, "held");
  const RunStatus starting = control.status(std::chrono::hours(1));
  EXPECT_EQ(starting.state, RunState::starting);
  EXPECT_EQ(starting.mission, "held");
  RunStatus ended;
  ended.state = RunState::ended;
  ended.outcome = "done";
  control.publish(ended);
  EXPECT_EQ(control.status(std::chrono::hours(1)).outcome, "done");
  EXPECT_EQ(control.status_in(RunState::paused, std::chrono::hours(1)).state, RunState::ended);
}

TEST(RunControl, AMissionThatDoesNotTickAnswersWithItsLastStatus) {
  ControlFlags flags;
  RunControl control(flags, "held");
  RunStatus running;
  running.state = RunState::running;
  running.time_s = 3.0;
  control.publish(running);
  EXPECT_EQ(control.status(std::chrono::milliseconds(0)).time_s, 3.0);
}

TEST(RunControl, TheMissionIsLookedAtOnlyWhenSomebodyWaits) {
  ControlFlags flags;
  RunControl control(flags, "held");
  RunStatus running;
  running.state = RunState::running;
  control.publish(running);
  control.tick([]() -> RunStatus { throw std::logic_error("nobody asked"); });
  RunStatus seen;
  std::atomic<bool> is_answered{false};
  std::thread asker([&] {
    seen = control.status(std::chrono::hours(1));
    is_answered = true;
  });
  running.time_s = 5.0;
  while (!is_answered) control.tick([&] { return running; });
  asker.join();
  EXPECT_EQ(seen.time_s, 5.0);
}

TEST(RunControl, EachStateHasAName) {
  EXPECT_EQ(name_of(RunState::starting), "starting");
  EXPECT_EQ(name_of(RunState::running), "running");
  EXPECT_EQ(name_of(RunState::paused), "paused");
  EXPECT_EQ(name_of(RunState::ended), "ended");
}

}  // namespace
}  // namespace cairn
