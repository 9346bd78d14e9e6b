#include "framework/safety/collision_monitor.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/framework/safety/velocity_limiter_scenes.hpp"

namespace cairn {
namespace {

class RecordingDrive : public Drive {
 public:
  void command(const Twist& twist) override {
    commands.push_back(twist);
    if (is_broken) throw std::runtime_error("the wheels are gone");
  }
  std::vector<Twist> commands;
  bool is_broken = false;
};

class MonitorOfADrive : public testing::Test {
 protected:
  MonitorOfADrive() { monitor_.attach({drive_, clock_, stage_}); }

  StageClock clock_;
  const StageClock::Id sensor_ = clock_.add("sensor", "robot");
  const StageClock::Id stage_ = clock_.add("drive", "robot");
  const StageClock::Id planner_ = clock_.add("planner", "hybrid");
  const std::shared_ptr<RecordingDrive> drive_ = std::make_shared<RecordingDrive>();
  CollisionMonitor monitor_{CollisionMonitorConfig{}, a_robot()};
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

TEST_F(MonitorOfADrive, StopsWhileTheHostIsBusyAndDrivesOnWithTheNextTick) {
  (void)monitor_.drive(observation(1.0), {0.1, 0.0});
  monitor_.stop();
  EXPECT_EQ(drive_->commands.back(), Twist{});
  (void)monitor_.drive(observation(1.0 + kTick_s), {0.1, 0.0});
  EXPECT_EQ(drive_->commands.back(), (Twist{0.1, 0.0}));
}

TEST_F(MonitorOfADrive, ADriveThatThrowsIsAFaultOfItsModule) {
  drive_->is_broken = true;
  try {
    monitor_.stop();
    FAIL() << "no fault";
  } catch (const ModuleFault& fault) {
    EXPECT_STREQ(fault.what(), "module robot failed in stage drive: the wheels are gone");
  }
}

TEST_F(MonitorOfADrive, StopsTheRobotOfAMissionThatWasGivenUpThoughTheDriveThrows) {
  drive_->is_broken = true;
  monitor_.stop_after_giving_up(planner_, sensor_);
  ASSERT_EQ(drive_->commands.size(), 1U);
  EXPECT_EQ(drive_->commands[0], Twist{});
}

TEST_F(MonitorOfADrive, LeavesADriveAloneWhoseModuleHasNotReturned) {
  monitor_.stop_after_giving_up(sensor_, sensor_);
  monitor_.stop_after_giving_up(stage_, sensor_);
  EXPECT_TRUE(drive_->commands.empty());
}

TEST(CollisionMonitor, WithoutADriveNothingIsOrdered) {
  CollisionMonitor monitor(CollisionMonitorConfig{}, a_robot());
  EXPECT_FALSE(monitor.has_drive());
  monitor.stop();
  EXPECT_EQ(monitor.drive(observation(1.0), {0.1, 0.0}).commanded, Twist{});
}

}  // namespace
}  // namespace cairn
