#include "plugins/simulated_robot/surroundings/witness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/simulated_robot/simulated_robot.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"
#include "tests/plugins/simulated_robot/witnessed.hpp"

namespace cairn {
namespace {

using testing::circle_at;
using testing::exact_robot;
using testing::room;
using testing::tilted_wall;

// The contacts of a drive, in their order.
std::vector<Contact> contacts(const World& world, const Pose2& T_map_start, const Twist& twist, double time_s,
                              const RobotModel& robot = exact_robot(), const SimulatedRobotConfig& config = {}) {
  SimulatedRobot sensor(config, robot, &world, T_map_start, 1);
  sensor.command(twist, kAlways_s);
  std::vector<Contact> seen;
  for (int i = 0; i < std::lround(time_s / 0.04); ++i) {
    const testing::Witnessed step = testing::observe(sensor);
    if (step.contact) seen.push_back(*step.contact);
  }
  EXPECT_EQ(static_cast<int>(seen.size()), sensor.collisions()) << "one a touch";
  return seen;
}

TEST(Witness, AWallAheadIsMetAtTheRobotsSpeedAndCouldBeSeen) {
  const auto met = contacts(tilted_wall(2.0, 0.0), {}, {0.4, 0.0}, 8.0);
  ASSERT_EQ(met.size(), 1U);
  EXPECT_NEAR(met[0].speed_mps, 0.4, 1e-6);
  EXPECT_TRUE(met[0].could_be_seen);
}

TEST(Witness, OnlyTheSpeedTowardsTheWallCounts) {
  const auto met = contacts(tilted_wall(2.0, 60.0), {}, {0.4, 0.0}, 8.0);
  ASSERT_GE(met.size(), 1U);
  EXPECT_NEAR(met[0].speed_mps, 0.4 * std::cos(radians(60.0)), 1e-4);
}

TEST(Witness, AWallBehindCouldNotBeSeen) {
  const auto met = contacts(tilted_wall(-1.0, 0.0), {}, {-0.2, 0.0}, 8.0);
  ASSERT_EQ(met.size(), 1U);
  EXPECT_NEAR(met[0].speed_mps, 0.2, 1e-6);
  EXPECT_FALSE(met[0].could_be_seen);
}

// From 0.4 m/s it takes 0.12 m to see it and 0.16 m to brake: 0.7 s at that speed.
TEST(Witness, ADoorThatClosesJustAheadCouldNotBeSeenInTime) {
  World world;
  WorldDoor& door = world.doors.emplace_back();
  door.from_m = {2.0, -1.0};
  door.to_m = {2.0, 1.0};
  const auto closing = [&](double at_s) {
    door.closed_s = {{at_s, 100.0}};
    return contacts(world, {}, {0.4, 0.0}, 8.0);
  };
  const auto early = closing(2.5);
  ASSERT_EQ(early.size(), 1U);
  EXPECT_TRUE(early[0].could_be_seen);
  const auto in_time = closing(3.8);
  ASSERT_EQ(in_time.size(), 1U);
  EXPECT_TRUE(in_time[0].could_be_seen) << "whoever does not brake has no excuse";
  const auto late = closing(4.3);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_NEAR(late[0].speed_mps, 0.4, 1e-6);
  EXPECT_FALSE(late[0].could_be_seen);
}

TEST(Witness, AFaultOfTheTransducerIsNoExcuse) {
  SimulatedRobotConfig config;
  config.faults.emplace_back().silent = true;
  const auto met = contacts(tilted_wall(2.0, 0.0), {}, {0.4, 0.0}, 8.0, exact_robot(), config);
  ASSERT_EQ(met.size(), 1U);
  EXPECT_TRUE(met[0].could_be_seen);
}

// A pole beside the beam, met by the rim of the robot.
TEST(Witness, WhatStandsBesideTheBeamCouldNotBeSeen) {
  World world;
  world.objects = {circle_at({0.5, 0.24}, 0.1)};
  RobotModel narrow = exact_robot();
  narrow.sonars[0].half_beam_rad = radians(5.0);
  const Pose2 T_map_start{0.15, 0.0, 0.0};
  EXPECT_FALSE(contacts(world, T_map_start, {0.4, 0.0}, 3.0, narrow).at(0).could_be_seen);
  narrow.sonars[0].half_beam_rad = radians(45.0);
  EXPECT_TRUE(contacts(world, T_map_start, {0.4, 0.0}, 3.0, narrow).at(0).could_be_seen);
}

TEST(Witness, WhatHidesBehindSomethingElseCouldNotBeSeen) {
  // A low wall stands between the transducer and the pole until they touch.
  World world;
  world.objects = {circle_at({1.5, 0.3}, 0.2)};
  RobotModel aside = exact_robot();
  aside.sonars[0].T_robot_sonar = {0.0, -1.0, radians(75.0)};
  const Pose2 T_map_start{0.6, 0.0, 0.0};
  EXPECT_TRUE(contacts(world, T_map_start, {0.4, 0.0}, 4.0, aside).at(0).could_be_seen);
  world.walls = {testing::wall({{-1.0, -0.5}, {4.0, -0.5}})};
  EXPECT_FALSE(contacts(world, T_map_start, {0.4, 0.0}, 4.0, aside).at(0).could_be_seen);
}

WorldMover runner(const Point& from_m, const Point& to_m, double speed_mps) {
  WorldMover mover;
  mover.contour = Contour::circle(0.4);
  mover.path_m = {from_m, to_m};
  mover.speed_mps = speed_mps;
  mover.course = Course::once;
  mover.waits = false;
  return mover;
}

TEST(Witness, ARobotThatStandsIsTouchedAtNoSpeed) {
  World world = room(6.0, 5.0);
  world.movers = {runner({5, 2.5}, {1, 2.5}, 1.0)};
  const auto met = contacts(world, {2.0, 2.5, 0.0}, {}, 8.0);
  ASSERT_EQ(met.size(), 1U);
  EXPECT_EQ(met[0].speed_mps, 0.0);
  EXPECT_TRUE(met[0].could_be_seen) << "it came from ahead";
}

TEST(Witness, AMoverIsLookedForWhereItWas) {
  // It comes from behind the transducer's back, and is beside the beam all the time.
  World world = room(6.0, 5.0);
  world.movers = {runner({0.5, 2.5}, {5, 2.5}, 1.0)};
  const auto met = contacts(world, {3.0, 2.5, 0.0}, {0.1, 0.0}, 8.0);
  ASSERT_GE(met.size(), 1U);
  EXPECT_FALSE(met[0].could_be_seen);
  EXPECT_EQ(met[0].speed_mps, 0.0) << "the robot went away from it";
}

}  // namespace
}  // namespace cairn
