// A running mission that is paused, asked and cancelled by another thread.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "framework/behaviour_tree/node_runs.hpp"
#include "tests/framework/mission/still_modules.hpp"

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
  const MissionResult result = run(1000000, nullptr);
  asker.join();
  EXPECT_EQ(result.outcome, MissionOutcome::cancelled);
  EXPECT_EQ(paused.state, RunState::paused);
  EXPECT_EQ(paused.mission, "still");
  EXPECT_EQ(paused.steps, 1U);
  EXPECT_EQ(ended.outcome, "cancelled");
  EXPECT_EQ(ended.map_file, "still.cairn");
  EXPECT_EQ(result.time_s, 0.0);
}

NodeReport report_of(double end_s, Progress progress) {
  NodeReport report;
  report.end_s = end_s;
  report.status.progress = progress;
  return report;
}

TEST(NodeRuns, KeepEachRunAndJoinAnswersGivenAtOnceAgainAndAgain) {
  TreeNode node;
  node.path = "1/1";
  NodeRuns runs;
  for (int i = 0; i < 5; ++i) runs.add(node, report_of(0.04 * i, Progress::failure), 0.04 * i);
  runs.add(node, report_of(0.2, Progress::success), 0.2);
  runs.add(node, report_of(3.0, Progress::success), 1.0);
  ASSERT_EQ(runs.runs().size(), 3U);
  EXPECT_EQ(runs.runs()[0].runs, 5);
  EXPECT_DOUBLE_EQ(runs.runs()[0].end_s, 0.16);
  EXPECT_EQ(runs.runs()[1].end, RunEnd::success);
  EXPECT_DOUBLE_EQ(runs.runs()[2].begin_s, 1.0);
}

TEST(NodeRuns, AreNoMoreThanTheirMostAndSayHowManyAreLeftOut) {
  TreeNode node;
  node.path = "1";
  NodeRuns runs;
  for (std::size_t i = 0; i < kMaxNodeRuns + 7; ++i) {
    const double begun_s = 2.0 * static_cast<double>(i);
    runs.add(node, report_of(begun_s + 1.0, Progress::success), begun_s);
  }
  EXPECT_EQ(runs.runs().size(), kMaxNodeRuns);
  EXPECT_EQ(runs.left_out(), 7);
}

}  // namespace
}  // namespace cairn
