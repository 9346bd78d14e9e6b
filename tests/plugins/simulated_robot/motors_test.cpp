#include "plugins/simulated_robot/motors.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/plugins/simulated_robot/test_worlds.hpp"

namespace cairn {
namespace {

RobotModel robot_of(double acceleration_mps2) {
  RobotModel robot;
  robot.max_v_mps = 0.5;
  robot.max_w_radps = 1.0;
  robot.max_acceleration_mps2 = acceleration_mps2;
  robot.max_turn_acceleration_radps2 = 2.0;
  return robot;
}

TEST(Motors, ReachTheCommandedVelocityWithinTheRobotsAccelerations) {
  Motors motors(robot_of(1.0));
  motors.command({0.3, 0.0}, kAlways_s);
  EXPECT_DOUBLE_EQ(motors.turn(0.2, true).v_mps, 0.1) << "the mean of the tick";
  EXPECT_DOUBLE_EQ(motors.twist().v_mps, 0.2);
  (void)motors.turn(0.2, true);
  EXPECT_DOUBLE_EQ(motors.twist().v_mps, 0.3);
  EXPECT_DOUBLE_EQ(motors.speed_ratio(), 0.6);
}

TEST(Motors, AreNoFasterThanTheRobot) {
  Motors motors(robot_of(100.0));
  motors.command({5.0, -9.0}, kAlways_s);
  for (int i = 0; i < 100; ++i) (void)motors.turn(0.1, true);
  EXPECT_DOUBLE_EQ(motors.twist().v_mps, 0.5);
  EXPECT_DOUBLE_EQ(motors.twist().w_radps, -1.0);
}

TEST(Motors, BrakeWithoutPower) {
  Motors motors(robot_of(1.0));
  motors.command({0.3, 0.0}, kAlways_s);
  for (int i = 0; i < 10; ++i) (void)motors.turn(0.1, true);
  for (int i = 0; i < 10; ++i) (void)motors.turn(0.1, false);
  EXPECT_NEAR(motors.twist().v_mps, 0.0, 1e-12);
}

TEST(Motors, BrakeWhenTheTimeOfTheirCommandHasPassed) {
  Motors motors(robot_of(1.0));
  motors.command({0.3, 0.0}, 0.5);
  for (int i = 0; i < 5; ++i) (void)motors.turn(0.1, true);
  EXPECT_NEAR(motors.twist().v_mps, 0.3, 1e-12);
  for (int i = 0; i < 5; ++i) (void)motors.turn(0.1, true);
  EXPECT_EQ(motors.twist(), Twist{});
}

// The stop of a watcher that finds the machine slow, between the host's command and the simulator's next step.
TEST(Motors, AStopBeforeAnyTimeHasPassedSinceTheCommandDoesNotChangeTheNextTurn) {
  Motors motors(robot_of(1.0));
  Motors undisturbed(robot_of(1.0));
  for (int i = 0; i < 20; ++i) {
    motors.command({0.3, 0.1}, kAlways_s);
    undisturbed.command({0.3, 0.1}, kAlways_s);
    if (i % 3 == 0) motors.stop();
    EXPECT_EQ(motors.turn(0.04, true), undisturbed.turn(0.04, true)) << i;
    if (i % 3 == 1) motors.stop();
  }
}

TEST(Motors, BrakeWhenTheyAreStoppedUntilTheNextCommand) {
  Motors motors(robot_of(1.0));
  motors.command({0.3, 0.0}, kAlways_s);
  for (int i = 0; i < 5; ++i) (void)motors.turn(0.1, true);
  motors.stop();
  (void)motors.turn(0.1, true);
  EXPECT_LT(motors.twist().v_mps, 0.3) << "at once, when time has passed since the command";
  for (int i = 0; i < 4; ++i) (void)motors.turn(0.1, true);
  EXPECT_EQ(motors.twist(), Twist{});
  motors.command({0.3, 0.0}, kAlways_s);
  (void)motors.turn(0.1, true);
  EXPECT_GT(motors.twist().v_mps, 0.0);
}

TEST(Motors, BrakeHarderInAnEmergencyThanByCommand) {
  const auto after = [&](auto end) {
    Motors motors(robot_of(0.5), 4.0);
    motors.command({0.4, 0.0}, 0.8);
    for (int i = 0; i < 8; ++i) (void)motors.turn(0.1, true);
    end(motors);
    (void)motors.turn(0.1, true);
    return motors.twist().v_mps;
  };
  EXPECT_NEAR(after([](Motors& motors) { motors.command({}, kAlways_s); }), 0.35, 1e-12);
  EXPECT_NEAR(after([](Motors& motors) { motors.stop(); }), 0.2, 1e-12);
  EXPECT_NEAR(after([](Motors&) {}), 0.2, 1e-12) << "the time of the command has passed";
}

TEST(Motors, KeepACarToItsTurningRadius) {
  RobotModel car = robot_of(100.0);
  car.kinematics = Kinematics::car;
  car.min_turning_radius_m = 1.0;
  Motors motors(car);
  motors.command({0.4, 1.0}, kAlways_s);
  for (int i = 0; i < 10; ++i) (void)motors.turn(0.1, true);
  EXPECT_DOUBLE_EQ(motors.twist().w_radps, 0.4);
}

TEST(Motors, RefuseACommandThatIsNotFinite) {
  Motors motors(robot_of(1.0));
  EXPECT_THROW(motors.command({std::numeric_limits<double>::quiet_NaN(), 0.0}, kAlways_s), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
