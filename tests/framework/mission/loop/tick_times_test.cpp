// The times of a mission's ticks: modules that do not return, stages, and missions in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <future>

#include "framework/mission/loop/mission_loop.hpp"
#include "tests/framework/mission/still_modules.hpp"
#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

class TickTimes : public testing::Test {
 protected:
  TickTimes() { std::filesystem::create_directories(folder_); }
  ~TickTimes() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_tick_times_" + std::to_string(getpid()));
};

// Hangs until the test lets it go, an hour by the mission's clock.
class Hanging : public Behaviour {
 public:
  struct Strings {
    std::shared_ptr<TestClock> clock = std::make_shared<TestClock>();
    std::promise<void> release;
    std::shared_future<void> released = release.get_future().share();
    std::promise<void> destroyed;
  };
  explicit Hanging(std::shared_ptr<Strings> strings) : strings_(std::move(strings)) {}
  ~Hanging() override { strings_->destroyed.set_value(); }
  Status tick(const WorldView&, BehaviourContext&) override {
    strings_->clock->advance(std::chrono::hours(1));
    strings_->released.wait();
    return {StepState::success, "late, but here"};
  }
  void halt() override {}

 private:
  std::shared_ptr<Strings> strings_;
};

class CountingListener : public Listener {
 public:
  void on(const Event&, const MissionView&) override { ++events; }
  std::atomic<int> events = 0;
};

TEST_F(TickTimes, AModuleThatDoesNotReturnIsGivenUpByTheMissionsClockAndTouchesNothingWhenItDoes) {
  const auto strings = std::make_shared<Hanging::Strings>();
  ModuleLibrary library = still::library();
  Registrar registrar;
  registrar.add<Behaviour, NoConfig>("hang", "returns late", [strings](const NoConfig&, const ModuleContext&) {
    return std::make_unique<Hanging>(strings);
  });
  library.add("(test)", registrar);
  Mission mission = still::mission(100);
  mission.config.watchdog_s = 30.0;
  mission.steps.front().choice.name = "hang";
  RunOptions options{folder_};
  options.wall_clock = strings->clock;
  CountingListener listener;
  {
    MissionRunner runner(mission, library, options);
    runner.subscribe(listener);
    const MissionResult result = runner.run();
    EXPECT_TRUE(runner.gave_up());
    EXPECT_EQ(result.reason, "module hang has not returned from stage behaviour for 30000 ms and was given up");
    EXPECT_EQ(result.steps.at(0).status.state, StepState::failure);
    EXPECT_EQ(result.nodes.at(0).status.state, StepState::failure);
    EXPECT_EQ(result.map_file, "still.cairn");
  }
  const int events = listener.events;
  strings->release.set_value();
  strings->destroyed.get_future().wait();  // with the loop, when its thread has ended
  EXPECT_EQ(listener.events, events);
}

// Takes its time, by a clock that only it and its like move on.
class Slow : public Behaviour {
 public:
  explicit Slow(std::shared_ptr<TestClock> clock) : clock_(std::move(clock)) {}
  Status tick(const WorldView&, BehaviourContext&) override {
    clock_->advance(std::chrono::milliseconds(7));
    return {StepState::running, {}};
  }
  void halt() override {}

 private:
  std::shared_ptr<TestClock> clock_;
};

class SlowListener : public Listener {
 public:
  explicit SlowListener(std::shared_ptr<TestClock> clock) : clock_(std::move(clock)) {}
  void on(const Event& event, const MissionView&) override {
    if (std::holds_alternative<TickDone>(event)) clock_->advance(std::chrono::milliseconds(2));
  }

 private:
  std::shared_ptr<TestClock> clock_;
};

TEST_F(TickTimes, EveryStageOfATickIsListedAndTheirTimesSumToIt) {
  const auto clock = std::make_shared<TestClock>();
  ModuleLibrary library = still::library();
  Registrar registrar;
  registrar.add<Behaviour, NoConfig>("slow", "takes its time", [clock](const NoConfig&, const ModuleContext&) {
    return std::make_unique<Slow>(clock);
  });
  library.add("(test)", registrar);
  Mission mission = still::mission(20);
  mission.steps.front().choice.name = "slow";
  RunOptions options{folder_};
  options.wall_clock = clock;
  SlowListener listener(clock);
  MissionRunner runner(mission, library, options);
  runner.subscribe(listener);
  (void)runner.run();
  std::vector<std::string> stages;
  double tick_s = 0.0;
  double sum_s = 0.0;
  for (const StageTime& time : runner.times()) {
    if (time.stage == "tick") {
      tick_s = time.total_s;
      EXPECT_EQ(time.count, 20);
      EXPECT_EQ(time.own_s, 0.0) << "of a tick that no stage accounts for";
    } else if (time.stage != "sensor") {
      stages.push_back(time.stage);
      sum_s += time.own_s;
    }
  }
  EXPECT_THAT(stages, testing::IsSupersetOf({"observation", "echo prediction", "perception", "localizer", "map",
                                             "detector", "landmark tracker", "behaviour tree", "behaviour",
                                             "collision monitor", "drive", "listeners", "run control", "autosave"}));
  EXPECT_NEAR(tick_s, 20 * 9e-3, 1e-9);
  EXPECT_NEAR(sum_s, tick_s, 1e-9);
}

TEST_F(TickTimes, AMissionInRealTimeTakesAsLongAsItsStampsSay) {
  const auto clock = std::make_shared<TestClock>();
  const double begin_s = clock->seconds();
  const ModuleLibrary library = still::library();
  RunOptions options{folder_, true};
  options.wall_clock = clock;
  (void)MissionRunner(still::mission(101), library, options).run();
  EXPECT_NEAR(clock->seconds() - begin_s, 4.0, 1e-3);
}

}  // namespace
}  // namespace cairn
