#include "framework/safety/collision_monitor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <latch>
#include <stdexcept>
#include <thread>

#include "tests/framework/modules/test_clock.hpp"
#include "tests/framework/safety/velocity_limiter_scenes.hpp"

namespace cairn {
namespace {

class RecordingDrive : public Drive {
 public:
  void command(const Twist& twist, double valid_for_s) override {
    commands.push_back(twist);
    last_valid_s = valid_for_s;
    if (on_command) on_command();
    if (is_broken) throw std::runtime_error("the wheels are gone");
  }
  void stop() noexcept override { ++stops; }
  std::function<void()> on_command;
  std::atomic<int> stops = 0;
  double last_valid_s = 0.0;
  std::vector<Twist> commands;
  bool is_broken = false;
};

class MonitorOfADrive : public testing::Test {
 protected:
  MonitorOfADrive() { monitor_.attach({drive_, clock_, stage_}); }
  void watch() {
    monitor_.stop_if_stalled([this] { ++stalls_; });
  }

  StageClock clock_;
  const StageClock::Id stage_ = clock_.add("drive", "robot");
  const std::shared_ptr<RecordingDrive> drive_ = std::make_shared<RecordingDrive>();
  const std::shared_ptr<TestClock> wall_clock_ = std::make_shared<TestClock>();
  CollisionMonitor monitor_{CollisionMonitorConfig{}, a_robot(), wall_clock_};
  int stalls_ = 0;
};

// One thread waits when it asks for the time for the nth time.
class HeldUpClock final : public WallClock {
 public:
  [[nodiscard]] Time now() const override {
    if (std::this_thread::get_id() == held_up_ && --asks_until_held_up_ == 0) {
      is_held_up_.count_down();
      released_.wait();
    }
    return clock_.now();
  }
  void sleep_for(std::chrono::nanoseconds duration) const override { clock_.sleep_for(duration); }
  [[nodiscard]] bool wait_for(const std::future<void>& done, std::chrono::nanoseconds at_most) const override {
    return clock_.wait_for(done, at_most);
  }
  void advance(std::chrono::nanoseconds duration) { clock_.advance(duration); }
  void hold_up_this_thread(int nth_ask) {
    asks_until_held_up_ = nth_ask;
    held_up_ = std::this_thread::get_id();
  }
  void wait_until_one_is_held_up() { is_held_up_.wait(); }
  void release() { released_.count_down(); }

 private:
  TestClock clock_;
  std::atomic<std::thread::id> held_up_{};
  mutable std::atomic<int> asks_until_held_up_{0};
  mutable std::latch is_held_up_{1};
  std::latch released_{1};
};

TEST_F(MonitorOfADrive, OrdersTheWantedVelocityWhereNothingIsNear) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  const DriveCommand given = monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(given.commanded, (Twist{0.1, 0.0}));
  EXPECT_EQ(given.speed_reduction_ratio, 0.0);
  EXPECT_EQ(drive_->commands.back(), given.commanded);
}

TEST_F(MonitorOfADrive, OrdersNoMoreThanWhatIsSeenAllowsAndSaysWhatItLeftOut) {
  Seen wall;
  wall.ahead_m = 0.16;
  (void)monitor_.drive(observation(1.0, wall), {});
  const DriveCommand given = monitor_.drive(observation(1.0 + kTick_s, wall), {0.3, 0.0});
  EXPECT_EQ(drive_->commands.back(), (Twist{0.0, 0.0}));
  EXPECT_EQ(given.speed_reduction_ratio, 1.0);
  EXPECT_GT(monitor_.figures().stopped_s, 0.0);
}

TEST_F(MonitorOfADrive, StandsWhileTheHostIsBusyAndDrivesOnWithTheNextTick) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  monitor_.stand();
  EXPECT_EQ(drive_->commands.back(), Twist{}) << "no emergency";
  EXPECT_EQ(drive_->stops, 0);
  wall_clock_->advance(std::chrono::milliseconds(800));
  watch();
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->commands.back(), (Twist{0.1, 0.0}));
  EXPECT_FALSE(monitor_.stalled_s()) << "it stood on purpose";
}

TEST_F(MonitorOfADrive, StopsAtOnceWhenSomethingHasFailed) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  monitor_.stop();
  EXPECT_EQ(drive_->stops, 1);
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->commands.back(), (Twist{0.1, 0.0}));
}

TEST_F(MonitorOfADrive, StopsAsCommandedWithoutReadingsAndAtOnceWhenTheyAreMissingForLong) {
  (void)monitor_.drive(observation(1.0), {0.3, 0.0});
  double stamp_s = 1.0 + kTick_s;
  for (; stamp_s < 1.24; stamp_s += kTick_s) (void)monitor_.drive(without_readings(stamp_s), {0.3, 0.0});
  EXPECT_EQ(drive_->commands.back(), Twist{});
  EXPECT_EQ(drive_->stops, 0) << "one round that is missing is no emergency";
  const std::size_t commands = drive_->commands.size();
  for (; stamp_s < 1.5; stamp_s += kTick_s) (void)monitor_.drive(without_readings(stamp_s), {0.3, 0.0});
  EXPECT_GE(drive_->stops, 4);
  EXPECT_LE(drive_->commands.size(), commands + 1) << "a command would let it brake more gently again";
  (void)monitor_.drive(observation(stamp_s), {0.3, 0.0});
  EXPECT_GT(drive_->commands.back().v_mps, 0.0) << "it goes on by itself";
}

TEST_F(MonitorOfADrive, StopsAtOnceWhenTheClockStands) {
  (void)monitor_.drive(observation(1.0), {0.3, 0.0});
  (void)monitor_.drive(observation(1.0), {0.3, 0.0});
  EXPECT_EQ(drive_->stops, 1);
}

TEST_F(MonitorOfADrive, ADriveThatThrowsIsAFaultOfItsModule) {
  drive_->is_broken = true;
  try {
    (void)monitor_.drive(observation(1.0), {});
    FAIL() << "no fault";
  } catch (const ModuleFault& fault) {
    EXPECT_STREQ(fault.what(), "module robot failed in stage drive: the wheels are gone");
  }
}

TEST_F(MonitorOfADrive, ACommandCountsForItsTimeOnly) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  EXPECT_EQ(drive_->last_valid_s, CollisionMonitorConfig{}.command_valid_s);
}

TEST_F(MonitorOfADrive, StopsTheWheelsOnceWhenNoTickEndsForLong) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  wall_clock_->advance(std::chrono::milliseconds(240));
  watch();
  EXPECT_EQ(stalls_, 0);
  EXPECT_EQ(drive_->stops, 0);
  wall_clock_->advance(std::chrono::milliseconds(20));
  watch();
  EXPECT_EQ(stalls_, 1);
  watch();
  EXPECT_EQ(stalls_, 1) << "it is known already";
  EXPECT_EQ(drive_->stops, 2) << "a stop may be lost";
}

TEST_F(MonitorOfADrive, DrivesOnWithTheNextTickAndSaysHowLongTheRobotStood) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  EXPECT_FALSE(monitor_.stalled_s());
  wall_clock_->advance(std::chrono::milliseconds(800));
  watch();
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->commands.back(), (Twist{0.1, 0.0}));
  ASSERT_TRUE(monitor_.stalled_s());
  EXPECT_NEAR(*monitor_.stalled_s(), 0.8, 1e-9);
  (void)monitor_.drive(observation(1.0 + 2.0 * kTick_s), {0.1, 0.0});
  EXPECT_FALSE(monitor_.stalled_s()) << "once";
}

TEST_F(MonitorOfADrive, SaysSoAlsoWhenTheWholeProcessStood) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  wall_clock_->advance(std::chrono::milliseconds(800));
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  ASSERT_TRUE(monitor_.stalled_s()) << "no other thread has run to stop the wheels: the drive's own time has";
  EXPECT_NEAR(*monitor_.stalled_s(), 0.8, 1e-9);
}

TEST_F(MonitorOfADrive, StopsTheWheelsAlsoWhileACommandDoesNotReturn) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  drive_->on_command = [&] {
    wall_clock_->advance(std::chrono::milliseconds(600));
    std::thread([&] { watch(); }).join();
  };
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->stops, 1);
  EXPECT_EQ(stalls_, 1);
}

TEST_F(MonitorOfADrive, ATickThatIsJustEndingIsNotStopped) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  wall_clock_->advance(std::chrono::milliseconds(600));
  drive_->on_command = [&] { std::thread([&] { watch(); }).join(); };
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  watch();
  EXPECT_EQ(drive_->stops, 0);
  EXPECT_EQ(stalls_, 0);
}

// The thread that watches is held up while it asks for the time, until the tick it looks at is over and the next one
// orders the drive.
TEST_F(MonitorOfADrive, AStallIsReportedOnceHoweverLateTheOneWhoWatchesIs) {
  const auto clock = std::make_shared<HeldUpClock>();
  CollisionMonitor monitor(CollisionMonitorConfig{}, a_robot(), clock);
  monitor.attach({drive_, clock_, stage_});
  (void)monitor.drive(observation(1.0), {0.1, 0.0});
  std::thread watching;
  drive_->on_command = [&] {
    clock->advance(std::chrono::milliseconds(600));
    watching = std::thread([&] {
      clock->hold_up_this_thread(2);
      monitor.stop_if_stalled([] {});
    });
    clock->wait_until_one_is_held_up();
  };
  (void)monitor.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_TRUE(monitor.stalled_s());
  drive_->on_command = [&] {
    clock->release();
    watching.join();
  };
  (void)monitor.drive(observation(1.0 + 2.0 * kTick_s), {0.1, 0.0});
  EXPECT_FALSE(monitor.stalled_s()) << "that was told already";
  drive_->on_command = {};
  (void)monitor.drive(observation(1.0 + 3.0 * kTick_s), {0.1, 0.0});
  EXPECT_FALSE(monitor.stalled_s());
}

TEST_F(MonitorOfADrive, StoppedForGoodItNeverLetsTheWheelsTurnAgain) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  monitor_.stop_for_good();
  EXPECT_EQ(drive_->stops, 1);
  const std::size_t commands = drive_->commands.size();
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->commands.size(), commands);
  EXPECT_EQ(drive_->stops, 2);
}

TEST_F(MonitorOfADrive, AStopForGoodDuringACommandIsNotUndoneByIt) {
  drive_->on_command = [&] { monitor_.stop_for_good(); };
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  EXPECT_EQ(drive_->stops, 2) << "once before the command counts, once after it";
}

TEST_F(MonitorOfADrive, AStallInWhichNobodyCouldLookIsOfTheWholeProcess) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  watch();
  wall_clock_->advance(std::chrono::milliseconds(600));
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_TRUE(monitor_.stalled_s());
  EXPECT_TRUE(monitor_.was_watch_held_up()) << "it has not looked yet";
  watch();
  wall_clock_->advance(std::chrono::milliseconds(600));
  watch();
  (void)monitor_.drive(observation(1.0 + 2.0 * kTick_s), {0.1, 0.0});
  EXPECT_TRUE(monitor_.was_watch_held_up()) << "it has looked again";
  for (int i = 0; i < 6; ++i) {
    wall_clock_->advance(std::chrono::milliseconds(100));
    watch();
  }
  (void)monitor_.drive(observation(1.0 + 3.0 * kTick_s), {0.1, 0.0});
  EXPECT_TRUE(monitor_.stalled_s());
  EXPECT_FALSE(monitor_.was_watch_held_up()) << "it looked all the time";
}

TEST(CollisionMonitor, WithoutADriveNothingIsOrdered) {
  CollisionMonitor monitor(CollisionMonitorConfig{}, a_robot());
  EXPECT_FALSE(monitor.has_drive());
  monitor.stop();
  monitor.stop_at_once();
  monitor.stop_if_stalled([] { FAIL(); });
  EXPECT_EQ(monitor.drive(observation(1.0), {0.1, 0.0}).commanded, Twist{});
}

}  // namespace
}  // namespace cairn
