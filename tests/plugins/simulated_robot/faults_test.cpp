#include "plugins/simulated_robot/faults.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "plugins/simulated_robot/simulated_robot.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"
#include "tests/plugins/simulated_robot/witnessed.hpp"

namespace cairn {
namespace {

using testing::exact_robot;
using ::testing::HasSubstr;
using testing::room;
using testing::Witnessed;

constexpr double kTick_s = 0.04;
constexpr double kInf = std::numeric_limits<double>::infinity();

SimulatedRobotConfig config_of(const std::string& text) {
  return load_config<SimulatedRobotConfig>(parse_config_text(text, "m.yaml"), "simulated_robot");
}

SimulatedRobotConfig with_fault(const std::string& fault) {
  return config_of("faults: [{at_s: 1, for_s: 1, " + fault + "}]");
}

std::string error_of(const std::string& text) {
  const World world = room(6.0, 5.0);
  try {
    SimulatedRobot(config_of(text), exact_robot(), &world, {1, 1, 0}, 1);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no ConfigError";
}

RobotModel two_sonars() {
  RobotModel robot = exact_robot();
  robot.sonars = {SonarModel{}, SonarModel{{0, 0, radians(90.0)}}};
  return robot;
}

// What a robot observes that drives as commanded, every transducer at every tick; by tick, from 1.
std::vector<Witnessed> run(SimulatedRobotConfig config, const Twist& twist, double time_s,
                           const RobotModel& robot = two_sonars(), std::uint64_t seed = 1,
                           const World& world = room(6.0, 5.0)) {
  config.fire_all = true;
  SimulatedRobot sensor(config, robot, &world, {1.5, 2.5, 0.0}, seed);
  sensor.command(twist, kAlways_s);
  std::vector<Witnessed> seen{{}};
  for (int i = 0; i < std::lround(time_s / kTick_s); ++i) seen.push_back(testing::observe(sensor));
  return seen;
}

// Ticks before, in and after the fault of a second after one second.
constexpr std::size_t kBefore = 24;
constexpr std::size_t kIn = 30;
constexpr std::size_t kAfter = 50;

TEST(Faults, ADeadTransducerHearsNoEcho) {
  const auto seen = run(with_fault("dead: [1]"), {}, 3.0);
  for (const std::size_t i : {kBefore, kAfter}) EXPECT_NEAR(seen[i].ranges[1].range_m, 2.5, 1e-9) << i;
  EXPECT_EQ(seen[kIn].ranges[1].range_m, kInf);
  EXPECT_NEAR(seen[kIn].ranges[0].range_m, 4.5, 1e-9) << "the others hear on";
}

TEST(Faults, ADeadTransducerCanReportNothingAtAll) {
  const auto seen = run(with_fault("dead: [0], reads: nothing"), {}, 3.0);
  ASSERT_EQ(seen[kIn].ranges.size(), 1U);
  EXPECT_EQ(seen[kIn].ranges[0].sensor, 1);
  EXPECT_EQ(seen[kAfter].ranges.size(), 2U);
}

TEST(Faults, ADeafRingHearsNothingAndADeafHalfLeavesTheOtherSide) {
  RobotModel robot = two_sonars();
  robot.sonars.push_back(SonarModel{{0, 0, radians(-90.0)}});
  const auto deaf_of = [&](const std::string& part) {
    const auto seen = run(with_fault("deaf: " + part), {}, 3.0, robot);
    std::vector<int> deaf;
    for (const RangeReading& reading : seen[kIn].ranges)
      if (reading.range_m == kInf) deaf.push_back(reading.sensor);
    for (const RangeReading& reading : seen[kAfter].ranges) EXPECT_NE(reading.range_m, kInf);
    return deaf;
  };
  EXPECT_EQ(deaf_of("whole"), (std::vector{0, 1, 2}));
  EXPECT_EQ(deaf_of("left"), (std::vector{0, 1})) << "ahead belongs to both";
  EXPECT_EQ(deaf_of("right"), (std::vector{0, 2}));
}

TEST(Faults, ADeafRingCanStrikeByChance) {
  const auto seen = run(config_of("random_faults: {per_hour: {deaf: 600}, for_s: 1}"), {}, 200.0);
  const auto silent = std::ranges::count_if(seen, [](const Witnessed& at) {
    return at.ranges.size() == 2 && at.ranges[0].range_m == kInf && at.ranges[1].range_m == kInf;
  });
  EXPECT_GT(silent, 25) << "the whole of it for a second, some time";
}

TEST(Faults, AStuckTransducerReadsItsRangeOrItsLastReading) {
  const Twist ahead{0.4, 0.0};
  const auto at_range = run(with_fault("stuck: {sonar: 0, range_m: 0.7}"), ahead, 3.0);
  EXPECT_EQ(at_range[kIn].ranges[0].range_m, 0.7);
  EXPECT_GT(at_range[kAfter].ranges[0].range_m, 3.0);
  const auto at_last = run(with_fault("stuck: {sonar: 0}"), ahead, 3.0);
  EXPECT_EQ(at_last[kIn].ranges[0].range_m, at_last[kBefore].ranges[0].range_m);
  EXPECT_LT(at_last[kAfter].ranges[0].range_m, at_last[kBefore].ranges[0].range_m);
}

TEST(Faults, SilenceLeavesClockAndOdometry) {
  const auto seen = run(with_fault("silent: true"), {0.4, 0.0}, 3.0);
  EXPECT_TRUE(seen[kIn].ranges.empty());
  EXPECT_EQ(seen[kAfter].ranges.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[kIn].stamp_s, kIn * kTick_s);
  EXPECT_GT(seen[kIn].T_odom_robot.x_m, seen[kBefore].T_odom_robot.x_m + 0.05);
}

TEST(Faults, ACompassJumpLastsAsLongAsItSays) {
  const auto seen = run(with_fault("compass_jump_deg: -40"), {}, 3.0);
  EXPECT_NEAR(*seen[kBefore].compass_rad, 0.0, 1e-12);
  EXPECT_NEAR(*seen[kIn].compass_rad, radians(-40.0), 1e-12);
  EXPECT_NEAR(*seen[kAfter].compass_rad, 0.0, 1e-12);
}

TEST(Faults, WheelsThatSlipCountMoreThanTheRobotGoes) {
  const auto way_m = [](const std::vector<Witnessed>& seen, std::size_t from, std::size_t to) {
    return std::pair{seen[to].T_odom_robot.x_m - seen[from].T_odom_robot.x_m,
                     seen[to].true_T_map_robot->x_m - seen[from].true_T_map_robot->x_m};
  };
  const auto seen = run(with_fault("slip: {wheel: both, ratio: 0.75}"), {0.4, 0.0}, 3.0);
  const auto [counted_m, gone_m] = way_m(seen, 25, 45);
  EXPECT_NEAR(gone_m, 0.25 * counted_m, 1e-9);
  EXPECT_GT(counted_m, 0.3);
  const auto [counted_after_m, gone_after_m] = way_m(seen, kAfter, 70);
  EXPECT_NEAR(gone_after_m, counted_after_m, 1e-9);
}

TEST(Faults, OneWheelThatSlipsTurnsTheRobotToItsSide) {
  const auto left = run(with_fault("slip: {wheel: left, ratio: 0.2}"), {0.4, 0.0}, 3.0);
  const auto right = run(with_fault("slip: {wheel: right, ratio: 0.2}"), {0.4, 0.0}, 3.0);
  EXPECT_GT(left[kAfter].true_T_map_robot->theta_rad, 0.1);
  EXPECT_NEAR(right[kAfter].true_T_map_robot->theta_rad, -left[kAfter].true_T_map_robot->theta_rad, 1e-9);
  EXPECT_EQ(left[kAfter].T_odom_robot.theta_rad, 0.0) << "the odometry does not know";
}

TEST(Faults, OnlyTheCompassReportsOfAKidnapping) {
  const auto config = config_of("faults: [{at_s: 1, kidnap: {to_m: [4, 1], angle_deg: 90}}]");
  const auto seen = run(config, {}, 3.0);
  EXPECT_EQ(*seen[kBefore].true_T_map_robot, (Pose2{1.5, 2.5, 0.0}));
  EXPECT_EQ(*seen[kIn].true_T_map_robot, (Pose2{4.0, 1.0, radians(90.0)}));
  EXPECT_EQ(seen[kAfter].T_odom_robot, Pose2{});
  EXPECT_NEAR(*seen[kIn].compass_rad, radians(90.0), 1e-12);
  EXPECT_FALSE(seen[kIn].bumped);
}

TEST(Faults, ItIsPutDownWhenAMoverHasLeftThePlace) {
  World world = room(6.0, 5.0);
  WorldMover person;
  person.contour = Contour::circle(0.4);
  person.path_m = {{4, 1}, {5, 1}};
  person.start_s = 1.5;
  world.movers = {person};
  const auto seen = run(config_of("faults: [{at_s: 1, kidnap: {to_m: [4, 1]}}]"), {}, 3.0, two_sonars(), 1, world);
  EXPECT_EQ(seen[kIn].true_T_map_robot->x_m, 1.5);
  EXPECT_EQ(seen.back().true_T_map_robot->x_m, 4.0);
}

TEST(Faults, WhatIsNotAtFaultReadsAsWithoutTheFault) {
  RobotModel robot = two_sonars();
  robot.range_error = RangeError{};
  robot.compass_error.noise_rad = 0.1;
  robot.odometry_error.distance_ratio = 0.1;
  const auto without = run({}, {0.2, 0.1}, 4.0, robot);
  for (const char* fault : {"dead: [1], reads: nothing", "stuck: {sonar: 1}", "silent: true", "compass_jump_deg: 30"}) {
    const auto with = run(with_fault(fault), {0.2, 0.1}, 4.0, robot);
    for (const std::size_t i : {kBefore, kAfter, without.size() - 1}) {
      EXPECT_EQ(with[i].ranges[0].range_m, without[i].ranges[0].range_m) << fault << i;
      EXPECT_EQ(with[i].compass_rad, without[i].compass_rad) << fault << i;
      EXPECT_EQ(with[i].T_odom_robot, without[i].T_odom_robot) << fault << i;
    }
  }
}

TEST(Faults, ChanceStrikesAtItsRateAndOtherwiseWithAnotherSeed) {
  const auto config = config_of("random_faults: {per_hour: {kidnap: 6}}");
  const World world = room(6.0, 5.0);
  std::set<int> counts;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Faults faults({}, config.random_faults, two_sonars(), world, seed);
    int kidnaps = 0;
    for (int i = 1; i < 36000; ++i) {
      faults.advance(i);
      if (!faults.kidnap()) continue;
      ++kidnaps;
      faults.kidnapped();
    }
    EXPECT_NEAR(kidnaps, 60, 25) << "6 an hour for ten hours, to three deviations";
    counts.insert(kidnaps);
  }
  EXPECT_GT(counts.size(), 1U);
}

TEST(Faults, EveryKindStrikesByChance) {
  const World world = room(6.0, 5.0);
  for (const char* kind : {"dead", "stuck", "slip", "compass_jump", "silent", "kidnap"}) {
    const auto config = config_of("random_faults: {per_hour: {" + std::string(kind) + ": 3600}, for_s: 5}");
    const auto seen = run(config, {0.3, 0.0}, 10.0), again = run(config, {0.3, 0.0}, 10.0),
               without = run({}, {0.3, 0.0}, 10.0);
    bool differs = false;
    for (std::size_t i = 1; i < seen.size(); ++i) {
      EXPECT_EQ(*seen[i].true_T_map_robot, *again[i].true_T_map_robot) << kind;
      differs |= *seen[i].true_T_map_robot != *without[i].true_T_map_robot;
      differs |= seen[i].compass_rad != without[i].compass_rad || seen[i].ranges.size() != without[i].ranges.size();
      for (std::size_t k = 0; k < seen[i].ranges.size() && !differs; ++k)
        differs = seen[i].ranges[k].range_m != without[i].ranges[k].range_m;
    }
    EXPECT_TRUE(differs) << kind;
  }
}

TEST(Faults, SayWhatIsWrongWithThem) {
  EXPECT_EQ(error_of("faults:\n  - {at_s: 1}\n"),
            "m.yaml:2:5: a fault needs one of dead, deaf, stuck, slip, compass_jump_deg, silent, kidnap");
  EXPECT_EQ(
      error_of("faults:\n  - {at_s: 1, silent: true, dead: [0]}\n"),
      "m.yaml:2:29: a fault takes only one of dead, deaf, stuck, slip, compass_jump_deg, silent, kidnap, found both "
      "\"silent\" and \"dead\"");
  EXPECT_THAT(error_of("faults: [{at_s: 1, silnt: true}]"), HasSubstr("(did you mean \"silent\"?)"));
  EXPECT_THAT(error_of("faults: [{at_s: 1, slip: {wheel: lefft}}]"), HasSubstr("(did you mean \"left\"?)"));
  EXPECT_THAT(error_of("faults: [{silent: true}]"), HasSubstr("lacks the key \"at_s\""));
  EXPECT_EQ(error_of("faults: [{at_s: 1, dead: [0, 7]}]"), "m.yaml:1:10: the robot has no transducer 7; it has 0 to 0");
  EXPECT_EQ(error_of("faults: [{at_s: 1, dead: [0.5]}]"),
            "m.yaml:1:27: each item of dead must be the number of a transducer, found 0.5");
  EXPECT_EQ(error_of("faults: [{at_s: 1, silent: true, reads: nothing}]"),
            "m.yaml:1:41: reads goes with dead and deaf");
  EXPECT_THAT(error_of("faults: [{at_s: 1, for_s: 2, kidnap: {to_m: [1, 1]}}]"), HasSubstr("kidnap happens once"));
  EXPECT_EQ(error_of("faults: [{at_s: 1, kidnap: {to_m: [0.1, 2]}}]"),
            "m.yaml:1:10: the robot cannot be put down at (0.10, 2.00) m: it would overlap wall 1");
  EXPECT_THAT(error_of("faults: [{at_s: 1, kidnap: {to_m: [9, 2]}}]"), HasSubstr("outside the world's bounds_m"));
}

TEST(Battery, RunsDownFasterWhenDrivingAndThenMovesNothing) {
  const auto config = config_of("battery: {standing_s: 20, driving_s: 10}");
  EXPECT_FALSE(run({}, {}, 0.1).back().battery_ratio);
  EXPECT_NEAR(*run(config, {}, 5.0).back().battery_ratio, 0.75, 1e-9);
  const auto driven = run(config_of("battery: {standing_s: 20, driving_s: 4, start_ratio: 0.5}"), {0.4, 0.0}, 4.0);
  EXPECT_EQ(*driven.back().battery_ratio, 0.0);
  EXPECT_EQ(*driven.back().true_T_map_robot, *driven[driven.size() - 5].true_T_map_robot) << "it stands";
}

}  // namespace
}  // namespace cairn
