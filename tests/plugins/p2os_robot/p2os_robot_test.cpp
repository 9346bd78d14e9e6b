// Whatever happens on either side of the line, the wheels stand within half a second.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "framework/live/live_robot.hpp"
#include "framework/live/steady_time.hpp"
#include "plugins/p2os_robot/microcontroller.hpp"
#include "tests/plugins/common/time_to_stand.hpp"
#include "tests/plugins/p2os_robot/pioneer_on_a_terminal.hpp"

namespace cairn::p2os_robot {
namespace {

using testing::HasSubstr;

constexpr double kStands_s = 0.5;

RobotModel robot() {
  RobotModel model;
  model.sonars.resize(16);
  for (std::size_t i = 0; i < model.sonars.size(); ++i)
    model.sonars[i].T_robot_sonar.theta_rad = 0.3 * static_cast<double>(i);
  return model;
}

// Of this process, whichever thread has made them.
std::vector<pid_t> children() {
  std::vector<pid_t> all;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(thread.path() / "children");
    for (pid_t child = 0; file >> child;) all.push_back(child);
  }
  return all;
}

class P2osRobot : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<live::LiveRobot> connected(Config config = {}) const {
    config.device = pioneer.device();
    return std::make_unique<live::LiveRobot>(std::make_unique<Microcontroller>(config, robot()), config.stop_when,
                                             robot());
  }
  [[nodiscard]] static Observation next_of(live::LiveRobot& driven) {
    const SensorStep step = driven.next({});
    EXPECT_EQ(step.state, SensorState::observation) << step.reason;
    return step.observation;
  }
  // Orders 0.2 m/s at each observation, as a mission does.
  static void drive(live::LiveRobot& driven, double for_s, const Twist& twist = {0.2, 0.0}) {
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < for_s;) {
      (void)next_of(driven);
      driven.drive()->command(twist, 0.3);
    }
  }
  [[nodiscard]] auto stands() {
    return [this](double within_s) { return pioneer.wait_for_wheels(false, within_s).has_value(); };
  }
  // The same until it is that fast, which takes longer on a busy machine.
  [[nodiscard]] bool comes_to_speed(live::LiveRobot& driven) const {
    const auto is_there = [&] { return std::abs(pioneer.v_mps() - 0.2) < 1e-9; };
    for (const double begin_s = live::now_s(); !is_there() && live::now_s() - begin_s < 3.0;) drive(driven, 0.05);
    return is_there();
  }
  // The same in another process, until the line is gone.
  [[nodiscard]] pid_t drive_elsewhere() const {
    const pid_t process = ::fork();
    if (process == 0) {
      const auto driven = connected();
      while (driven->next({}).state == SensorState::observation) driven->drive()->command({0.2, 0.0}, 0.3);
      ::_exit(1);
    }
    return process;
  }

  PioneerOnATerminal pioneer;
};

TEST_F(P2osRobot, DrivesAndSeesWhereItIs) {
  const auto driven = connected();
  const Observation first = next_of(*driven);
  EXPECT_TRUE(pioneer.is_in_session());
  ASSERT_FALSE(first.ranges.empty());
  EXPECT_DOUBLE_EQ(first.ranges[0].range_m, 1.0);
  EXPECT_DOUBLE_EQ(*first.battery_ratio, 0.75);
  EXPECT_FALSE(first.compass_rad);
  EXPECT_FALSE(first.bumped);
  drive(*driven, 1.0);
  EXPECT_TRUE(comes_to_speed(*driven));
  const Observation last = next_of(*driven);
  EXPECT_GT(last.T_odom_robot.x_m, 0.08);
  EXPECT_LT(last.T_odom_robot.x_m, 0.3);
  EXPECT_NEAR(last.stamp_s - first.stamp_s, 1.0, 0.5);
}

TEST_F(P2osRobot, StandsWhenNobodyOrdersAnyMore) {
  const auto driven = connected();
  drive(*driven, 0.5);
  const TimeToStand time("no order any more");
  EXPECT_TRUE(time.is_short(stands()));
}

TEST_F(P2osRobot, StandsAtOnceWhenToldTo) {
  const auto driven = connected();
  drive(*driven, 0.5);
  driven->drive()->stop();
  EXPECT_TRUE(pioneer.wait_for_wheels(false, 0.15));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(pioneer.v_mps(), 0.0) << "and is not sent on by an earlier order";
}

TEST_F(P2osRobot, StandsWhenItIsDestroyed) {
  auto driven = connected();
  drive(*driven, 0.5);
  const TimeToStand time("the module is unloaded");
  driven.reset();
  EXPECT_TRUE(time.is_short(stands()));
  for (int i = 0; i < 100 && pioneer.is_in_session(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(pioneer.is_in_session());
}

TEST_F(P2osRobot, StandsWhenItsProcessIsKilledOrStopped) {
  pioneer.watchdog_s = 10.0;
  for (const int signal : {SIGKILL, SIGSTOP}) {
    const pid_t process = drive_elsewhere();
    ASSERT_TRUE(pioneer.wait_for_wheels(true, 5.0));
    const TimeToStand time(signal == SIGKILL ? "SIGKILL" : "SIGSTOP");
    ::kill(process, signal);
    EXPECT_TRUE(time.is_short(stands()));
    ::kill(process, SIGCONT);
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    ASSERT_TRUE(pioneer.wait_for_wheels(false, kStands_s)) << signal;
  }
}

TEST_F(P2osRobot, GoesOnAfterItsProcessWasStopped) {
  const pid_t process = drive_elsewhere();
  ASSERT_TRUE(pioneer.wait_for_wheels(true, 5.0));
  ::kill(process, SIGSTOP);
  ASSERT_TRUE(pioneer.wait_for_wheels(false, kStands_s));
  ::kill(process, SIGCONT);
  EXPECT_TRUE(pioneer.wait_for_wheels(true, 5.0));
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

// Somebody ends the process that guards the wheels: the next connection has another one.
TEST_F(P2osRobot, GoesOnWithAnotherGuardWhenItsOwnIsKilled) {
  const auto driven = connected();
  drive(*driven, 0.3);
  const std::vector<pid_t> guards = children();
  ASSERT_EQ(guards.size(), 1U);
  ::kill(guards[0], SIGKILL);
  drive(*driven, 1.0);
  EXPECT_TRUE(comes_to_speed(*driven));
  ASSERT_EQ(children().size(), 1U);
  EXPECT_NE(children()[0], guards[0]);
}

TEST_F(P2osRobot, StandsWhenTheBaseSaysNothingAndGoesOnWhenItDoes) {
  const auto driven = connected();
  drive(*driven, 0.5);
  pioneer.is_silent = true;
  std::thread again([this] {
    const TimeToStand time("the base says nothing");
    EXPECT_TRUE(time.is_short(stands()));
    pioneer.is_silent = false;
  });
  (void)next_of(*driven);  // waits through the silence
  again.join();
  drive(*driven, 0.5);
  EXPECT_TRUE(comes_to_speed(*driven));
}

TEST_F(P2osRobot, DamagedPacketsAreLeftOut) {
  const auto driven = connected();
  (void)next_of(*driven);
  pioneer.is_damaging = true;
  for (int i = 0; i < 10; ++i) EXPECT_DOUBLE_EQ(next_of(*driven).ranges.at(0).range_m, 1.0);
}

TEST_F(P2osRobot, PacketsThatComeTwiceChangeNothing) {
  const auto driven = connected();
  pioneer.is_doubling = true;
  const double begin_m = next_of(*driven).T_odom_robot.x_m;
  drive(*driven, 1.0);
  EXPECT_TRUE(comes_to_speed(*driven));
  EXPECT_NEAR(next_of(*driven).T_odom_robot.x_m - begin_m, 0.15, 0.06);
  drive(*driven, 0.2);
  const TimeToStand time("no order any more, packets come twice");
  EXPECT_TRUE(time.is_short(stands()));
}

// Nothing can be said to the wheels then: the base's own watchdog stops them. They must not turn again when the cable
// is back, with what they were ordered before.
TEST_F(P2osRobot, ACableThatIsPulledWhileItTurnsStopsItByItsWatchdogAndForGood) {
  const std::filesystem::path cable =
      std::filesystem::temp_directory_path() / ("cairn_cable_" + std::to_string(::getpid()));
  const auto lay_cable = [&] {
    std::filesystem::remove(cable);
    std::filesystem::create_symlink(pioneer.device(), cable);
  };
  lay_cable();
  Config config;
  config.device = cable;
  live::LiveRobot driven(std::make_unique<Microcontroller>(config, robot()), config.stop_when, robot());
  drive(driven, 0.5, {0.0, radians(30.0)});
  ASSERT_EQ(pioneer.w_degps(), 30.0);
  pioneer.unplug();
  std::thread again([&] {
    const auto stood_s = pioneer.wait_for_wheels(false, pioneer.watchdog_s + kStands_s);
    EXPECT_TRUE(stood_s);
    std::cout << "the cable is pulled while it turns: velocity 0 after " << stood_s.value_or(-1.0)
              << " s, by its own watchdog\n";
    pioneer.plug_in();
    lay_cable();
    EXPECT_FALSE(pioneer.wait_for_wheels(true, 1.5)) << "an order of before";
  });
  EXPECT_EQ(driven.next({}).state, SensorState::observation) << "it is connected to again";
  again.join();
  drive(driven, 1.0);
  EXPECT_TRUE(comes_to_speed(driven));
  std::filesystem::remove(cable);
}

TEST_F(P2osRobot, BumpersAndStallsAreABump) {
  const auto driven = connected();
  for (const int word : {0x0001, 0x0100, 0x0004, 0x8000}) {
    pioneer.stall_and_bumpers = word;
    for (int i = 0; i < 2; ++i) (void)next_of(*driven);
    EXPECT_TRUE(next_of(*driven).bumped) << word;
  }
}

TEST_F(P2osRobot, MotorsThatAreSwitchedOffHoldItUntilAPersonSwitchesThemOn) {
  const auto driven = connected();
  drive(*driven, 0.5);
  EXPECT_EQ(pioneer.enables(), 1);
  pioneer.flags = 0;
  EXPECT_TRUE(pioneer.wait_for_wheels(false, kStands_s));
  for (int i = 0; i < 2; ++i) (void)next_of(*driven);
  EXPECT_EQ(next_of(*driven).stopped_by, "its motors, which are switched off (press its MOTORS button)");
  drive(*driven, 0.3);
  pioneer.is_silent = true;  // for so long that it is connected to again
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::thread again([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));
    pioneer.is_silent = false;
  });
  EXPECT_NE(next_of(*driven).stopped_by, "") << "also in the next session";
  again.join();
  drive(*driven, 0.3);
  EXPECT_EQ(pioneer.v_mps(), 0.0);
  EXPECT_EQ(pioneer.enables(), 1) << "not by Cairn";
  pioneer.flags = 1;
  drive(*driven, 1.0);
  EXPECT_EQ(next_of(*driven).stopped_by, "");
  EXPECT_TRUE(comes_to_speed(*driven));
}

TEST_F(P2osRobot, MotorsThatAreSwitchedOffWhileTheLineIsSilentStayOff) {
  const auto driven = connected();
  drive(*driven, 0.5);
  pioneer.is_silent = true;
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  pioneer.flags = 0;
  std::thread again([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));
    pioneer.is_silent = false;
  });
  (void)next_of(*driven);
  again.join();
  drive(*driven, 1.5);
  EXPECT_THAT(next_of(*driven).stopped_by, HasSubstr("its motors, which are switched off"));
  EXPECT_EQ(pioneer.v_mps(), 0.0);
  EXPECT_EQ(pioneer.enables(), 1) << "not by Cairn";
}

TEST_F(P2osRobot, ItsEmergencyButtonHoldsIt) {
  const auto driven = connected();
  drive(*driven, 0.5);
  pioneer.flags = 0x20;
  EXPECT_TRUE(pioneer.wait_for_wheels(false, kStands_s));
  for (int i = 0; i < 2; ++i) (void)next_of(*driven);
  EXPECT_EQ(next_of(*driven).stopped_by, "its emergency button");
  pioneer.flags = 0;  // released; the motors stay off
  for (int i = 0; i < 2; ++i) (void)next_of(*driven);
  EXPECT_THAT(next_of(*driven).stopped_by, HasSubstr("its motors, which are switched off"));
  drive(*driven, 0.3);
  EXPECT_EQ(pioneer.v_mps(), 0.0);
  pioneer.flags = 1;
  drive(*driven, 1.0);
  EXPECT_EQ(next_of(*driven).stopped_by, "");
  EXPECT_TRUE(comes_to_speed(*driven));
}

TEST_F(P2osRobot, MotorsThatDoNotComeOnAreSaid) {
  pioneer.flags = 0x20;
  const auto driven = connected();
  EXPECT_EQ(next_of(*driven).stopped_by, "its emergency button");
}

TEST_F(P2osRobot, ASonarThatTheFileDoesNotHaveIsAFault) {
  pioneer.first_sonar = 16;
  const SensorStep step = connected()->next({});
  EXPECT_EQ(step.state, SensorState::fault);
  EXPECT_THAT(step.reason, HasSubstr("has a sonar 16, the robot's file only 0 to 15"));
}

TEST_F(P2osRobot, NobodyThereIsAFaultWithWhatHelps) {
  Config config;
  config.stop_when.reconnect_s = 0.2;
  config.device = "/dev/no_such_line";
  live::LiveRobot driven(std::make_unique<Microcontroller>(config, robot()), config.stop_when, robot());
  const SensorStep step = driven.next({});
  EXPECT_EQ(step.state, SensorState::fault);
  EXPECT_THAT(step.reason, HasSubstr("/dev/no_such_line: No such file or directory: is the cable plugged in?"));
  EXPECT_EQ(driven.next({}).reason, step.reason);
}

TEST_F(P2osRobot, WhatIsNoSerialLineIsAFault) {
  Config config;
  config.stop_when.reconnect_s = 0.2;
  config.device = "/dev/null";
  live::LiveRobot driven(std::make_unique<Microcontroller>(config, robot()), config.stop_when, robot());
  EXPECT_THAT(driven.next({}).reason, HasSubstr("/dev/null: is no serial line"));
}

// PSOS has no switch of the motors that Cairn knows of.
TEST(P2osRobots, APioneer1SaysNothingOfItsMotors) {
  PioneerOnATerminal old("psos1m");
  Config config;
  config.device = old.device();
  live::LiveRobot driven(std::make_unique<Microcontroller>(config, robot()), config.stop_when, robot());
  EXPECT_EQ(driven.next({}).observation.stopped_by, "");
  EXPECT_EQ(old.enables(), 0);
}

TEST(P2osRobots, AModelThatIsNotKnownIsToldWithThoseThatAre) {
  const PioneerOnATerminal rover("rover");
  Config config;
  config.device = rover.device();
  live::LiveRobot driven(std::make_unique<Microcontroller>(config, robot()), config.stop_when, robot());
  EXPECT_THAT(driven.next({}).reason, HasSubstr("subclass \"rover\"), and in which units that counts is not known"));
}

TEST(P2osRobots, SettingsThatCannotBeAreRefused) {
  const auto refusal = [](auto change, const RobotModel& model) -> std::string {
    Config config;
    change(config);
    try {
      const Microcontroller made(config, model);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal([](Config& c) { c.baud = 9601; }, robot()), HasSubstr("`baud` is 9601; known are 9600, 19200"));
  EXPECT_THAT(refusal([](Config& c) { c.subclass = "p3dxsh"; }, robot()),
              HasSubstr("`subclass` \"p3dxsh\" is not known (did you mean \"p3dx-sh\"?)"));
  EXPECT_THAT(refusal([](Config& c) { c.battery_empty_v = 13.0; }, robot()),
              HasSubstr("`battery_full_v` 13 must be above `battery_empty_v` 13"));
  EXPECT_THAT(refusal([](Config&) {}, RobotModel{}), HasSubstr("the robot's file has no sonars"));
}

}  // namespace
}  // namespace cairn::p2os_robot
