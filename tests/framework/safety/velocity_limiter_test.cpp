#include "framework/safety/velocity_limiter.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "framework/config/config_value.hpp"
#include "tests/framework/safety/velocity_limiter_scenes.hpp"

namespace cairn {
namespace {

TEST(VelocityLimiter, LetsTheRobotGoWhenNothingIsNear) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
  EXPECT_EQ(layer.limit({0.3, 0.1}), (Twist{0.3, 0.1}));
  EXPECT_EQ(layer.figures().slowed_s, 0.0);
}

TEST(VelocityLimiter, StopsBeforeAnEchoThatIsAsNearAsTheMargin) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = a_robot().radius_m + 0.05 - 0.1});
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0);
  EXPECT_NEAR(layer.figures().stopped_s, kTick_s, 1e-9);
}

TEST(VelocityLimiter, AlwaysLeavesRoomToReactAndToBrake) {
  const RobotModel robot = a_robot();
  for (double range = 0.2; range < 2.0; range += 0.05) {
    const double v = layer_that_sees({.ahead_m = range}).limit({robot.max_v_mps, 0.0}).v_mps;
    const double way = std::max(0.0, range + 0.1 - robot.radius_m - 0.05);
    EXPECT_LE(v * kTick_s + v * v / (2.0 * robot.max_acceleration_mps2), way + 1e-9) << "range " << range;
    if (way > 0.6) {
      EXPECT_EQ(v, robot.max_v_mps) << "range " << range;
    }
  }
}

TEST(VelocityLimiter, TheReactionLastsUntilTheTransducerFiresAgain) {
  RobotModel robot = a_robot();
  robot.sonars.resize(7);
  const double at_once = layer_that_sees({.ahead_m = 0.35}).limit({0.4, 0.0}).v_mps;
  robot.firing_period_s = kTick_s;
  const double in_turn = layer_that_sees({.ahead_m = 0.35}, robot).limit({0.4, 0.0}).v_mps;
  EXPECT_LT(in_turn, 0.8 * at_once);
  const double way = 0.35 + 0.1 - robot.radius_m - 0.05;
  EXPECT_LE(in_turn * 8 * kTick_s + in_turn * in_turn / (2.0 * robot.max_acceleration_mps2), way + 1e-9);
}

TEST(VelocityLimiter, GoesSlowlyWhereSomethingIsNear) {
  const RobotModel robot = a_robot();
  VelocityLimiter towards = layer_that_sees({.ahead_m = 0.26});
  EXPECT_NEAR(towards.limit({0.4, 0.0}).v_mps, 0.4 * robot.max_v_mps, 1e-9);
  EXPECT_GT(towards.figures().slowed_s, 0.0);
  EXPECT_EQ(towards.limit({0.1, 0.0}).v_mps, 0.1) << "slow already";
}

TEST(VelocityLimiter, WhatIsBesideTheRobotAlreadyMayBePassedAlong) {
  // Farther than the margin and nearer than the slow zone, as in every narrow door.
  VelocityLimiter layer = layer_that_sees({.ahead_m = 3.0, .left_m = a_robot().radius_m});
  EXPECT_EQ(layer.limit({0.4, 0.0}).v_mps, 0.4);
}

TEST(VelocityLimiter, LooksAlongTheArcNotOnlyStraightAhead) {
  // Something to the left ahead: in the way of a left turn, not of a right one.
  const auto allowed = [](const Twist& wanted) {
    VelocityLimiter layer({.slow_m = 0.02}, a_robot());
    for (const double stamp_s : {1.0, 1.04}) {
      Observation o = observation(stamp_s);
      o.ranges.push_back(reading(0.25, radians(70.0), 3));
      layer.see(o);
    }
    return layer.limit(wanted).v_mps;
  };
  EXPECT_LT(allowed({0.4, 1.2}), allowed({0.4, 0.0}));
  EXPECT_EQ(allowed({0.4, -1.2}), 0.4);
}

// Rays all round, past a wall across the x axis.
Observation before_a_wall(double stamp_s, const Pose2& pose, double wall_m) {
  Observation o;
  o.stamp_s = stamp_s;
  o.T_odom_robot = pose;
  for (int i = 0; i < 36; ++i) {
    const double angle_rad = radians(10.0 * i);
    const double ahead = std::cos(pose.theta_rad + angle_rad);
    RangeReading ray = reading(ahead > 0.1 ? (wall_m - pose.x_m) / ahead : kInfinity, angle_rad, i);
    ray.T_robot_sensor = {0.0, 0.0, angle_rad};
    ray.half_beam_rad = 0.0;
    o.ranges.push_back(ray);
  }
  return o;
}

// The wanted arc clears the wall, the one on which the robot gets there does not.
TEST(VelocityLimiter, BrakesForTheArcThatTheRobotIsOnBeforeItHasTurned) {
  RobotModel robot = a_robot();
  robot.max_acceleration_mps2 = 0.2;
  robot.max_turn_acceleration_radps2 = radians(20.0);
  VelocityLimiter layer({.slow_m = 0.02, .blind_s = std::nullopt}, robot);
  const double wall_m = 1.6;
  const auto towards = [](double from, double to, double most) { return from + std::clamp(to - from, -most, most); };
  Pose2 pose;
  Twist twist;
  double nearest_m = kInfinity;
  bool has_turned_away = false;
  for (int tick = 1; tick < 600; ++tick) {
    layer.see(before_a_wall(kTick_s * tick, pose, wall_m));
    const Twist allowed = layer.limit(wall_m - pose.x_m > 0.7 ? Twist{0.4, 0.0} : Twist{0.4, 1.7});
    twist.v_mps = towards(twist.v_mps, allowed.v_mps, robot.max_acceleration_mps2 * kTick_s);
    twist.w_radps = towards(twist.w_radps, allowed.w_radps, robot.max_turn_acceleration_radps2 * kTick_s);
    pose = pose * Pose2{twist.v_mps * kTick_s, 0.0, twist.w_radps * kTick_s};
    nearest_m = std::min(nearest_m, wall_m - pose.x_m - robot.radius_m);
    has_turned_away = has_turned_away || std::cos(pose.theta_rad) < -0.5;
  }
  EXPECT_GT(nearest_m, 0.02);
  EXPECT_TRUE(has_turned_away) << "it is not stuck there";
}

RobotModel a_car() {
  RobotModel robot = a_robot();
  robot.kinematics = Kinematics::car;
  robot.min_turning_radius_m = 0.6;
  return robot;
}

TEST(VelocityLimiter, ACarsArcIsNoTighterThanItsTurningCircle) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0}, a_car());
  EXPECT_EQ(layer.limit({0.3, 1.5}), (Twist{0.3, 0.5}));
  EXPECT_EQ(layer.limit({-0.3, 1.5}), (Twist{-0.3, 0.5}));
  EXPECT_EQ(layer.limit({0.0, 1.5}), Twist{}) << "no car turns in place";
  // What is ahead is clear of the wanted arc, but not of the one that a car can drive.
  const auto allowed_mps = [](RobotModel robot) {
    robot.max_acceleration_mps2 = 0.2;
    return layer_that_sees({.ahead_m = 0.45}, robot, {.slow_m = 0.02, .blind_s = std::nullopt})
        .limit({0.35, 1.7})
        .v_mps;
  };
  EXPECT_EQ(allowed_mps(a_robot()), 0.35);
  EXPECT_LT(allowed_mps(a_car()), 0.35);
}

TEST(VelocityLimiter, SlowingDownKeepsTheArc) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = 0.3});
  const Twist allowed = layer.limit({0.4, 0.2});
  ASSERT_GT(allowed.v_mps, 0.0);
  EXPECT_NEAR(allowed.w_radps / allowed.v_mps, 0.5, 1e-9);
}

TEST(VelocityLimiter, WatchesItsBackToo) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = 3.0, .behind_m = 0.17});
  EXPECT_EQ(layer.limit({-0.3, 0.0}).v_mps, 0.0);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(VelocityLimiter, ADiscMayAlwaysTurnInPlaceAndBackAway) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = 0.12});
  EXPECT_EQ(layer.limit({0.0, 1.0}), (Twist{0.0, 1.0}));
  EXPECT_EQ(layer.limit({-0.2, 0.0}), (Twist{-0.2, 0.0}));
}

TEST(VelocityLimiter, APolygonDoesNotTurnItsCornersIntoWhatItSees) {
  RobotModel robot = a_robot();
  robot.polygon_m = {{-0.4, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.4, 0.15}};
  robot.radius_m = 0.43;
  VelocityLimiter layer({}, robot);
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.push_back(reading(0.27, radians(50.0), 3));  // beside the front left corner
    layer.see(o);
  }
  EXPECT_LT(layer.limit({0.0, 1.0}).w_radps, 0.5);
  EXPECT_EQ(layer.limit({0.0, -0.5}).w_radps, -0.5) << "the other corners are free";
}

RobotModel a_long_box() {
  RobotModel robot = a_robot();
  robot.polygon_m = {{-0.4, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.4, 0.15}};
  robot.radius_m = 0.43;
  return robot;
}

TEST(VelocityLimiter, APolygonThatIsTouchedCreepsWhenItTurnsInPlaceToo) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0}, a_long_box());
  Observation bump = observation(1.08, {3.0, 3.0, 3.0});
  bump.bumped = true;
  layer.see(bump);
  const double w_radps = layer.limit({0.0, 1.0}).w_radps;
  EXPECT_NEAR(w_radps * std::hypot(0.4, 0.15), 0.04, 1e-9) << "its fastest corner";
}

TEST(VelocityLimiter, APolygonTurnsSlowlyInTheSlowZone) {
  RobotModel robot = a_long_box();
  VelocityLimiter layer({.slow_m = 0.2}, robot);
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.push_back(reading(0.5, radians(40.0), 3));  // the front left corner comes within 0.1 m of it
    o.ranges.back().half_beam_rad = 0.0;
    layer.see(o);
  }
  EXPECT_NEAR(layer.limit({0.0, 1.0}).w_radps * std::hypot(0.4, 0.15), 0.4 * robot.max_v_mps, 1e-9);
  EXPECT_EQ(layer.limit({0.0, 0.3}).w_radps, 0.3) << "slow already";
}

TEST(VelocityLimiter, ReportsHowMuchOfATurnInPlaceItLeavesOut) {
  const VelocityLimiter layer({}, a_robot());
  EXPECT_EQ(layer.speed_reduction_ratio({0.0, 0.5}, {}), 1.0);
  EXPECT_EQ(layer.speed_reduction_ratio({0.0, -0.5}, {0.0, -0.25}), 0.5);
  EXPECT_EQ(layer.speed_reduction_ratio({0.0, 0.5}, {0.0, 0.5}), 0.0);
  EXPECT_EQ(layer.speed_reduction_ratio({0.0, 9.0}, {0.0, a_robot().max_w_radps}), 0.0)
      << "its own limit holds nothing back";
  EXPECT_EQ(layer.speed_reduction_ratio({0.2, 0.5}, {0.0, 0.5}), 1.0);
  EXPECT_EQ(layer.speed_reduction_ratio({}, {}), 0.0);
}

TEST(VelocityLimiter, AnEchoBesideTheRobotDoesNotHoldItBack) {
  EXPECT_EQ(layer_that_sees({.ahead_m = 3.0, .left_m = 0.5}).limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(VelocityLimiter, KeepsToTheRobotsLimitsAndRefusesWhatIsNoNumber) {
  const RobotModel robot = a_robot();
  VelocityLimiter layer = layer_that_sees({4.0, 4.0, 4.0});
  EXPECT_EQ(layer.limit({9.0, -9.0}), (Twist{robot.max_v_mps, -robot.max_w_radps}));
  EXPECT_EQ(layer.limit({std::numeric_limits<double>::quiet_NaN(), 0.0}), Twist{});
}

// In turns of a round; what is ahead is expected.
void listen(VelocityLimiter& layer, double from_s, int rounds, const Seen& seen, bool is_expected) {
  const std::vector<ExpectedEcho> expected =
      is_expected ? std::vector<ExpectedEcho>{{0, 1.0}} : std::vector<ExpectedEcho>{};
  for (int i = 0; i < rounds; ++i) layer.see(observation(from_s + 0.28 * i, seen), expected);
}

TEST(VelocityLimiter, CreepsToWhereADeafTransducerLooksUntilItHearsAgain) {
  VelocityLimiter layer = layer_that_sees({1.0, 3.0, 3.0});
  listen(layer, 2.0, 3, {.behind_m = 3.0}, true);
  EXPECT_NEAR(layer.limit({0.4, 0.1}).v_mps, 0.04, 1e-12);
  EXPECT_NEAR(layer.limit({0.4, 0.1}).w_radps, 0.01, 1e-12) << "on the same arc";
  EXPECT_EQ(layer.limit({-0.3, 0.0}).v_mps, -0.3) << "who looks back hears";
  EXPECT_EQ(layer.limit({0.0, 1.0}).w_radps, 1.0);
  EXPECT_GT(layer.figures().deaf_s, 0.0);
  listen(layer, 4.0, 1, {3.0, 3.0, 3.0}, false);
  EXPECT_EQ(layer.limit({0.4, 0.1}).v_mps, 0.4);
}

TEST(VelocityLimiter, ARobotThatHasHeardNothingForMetresGoesSlowly) {
  VelocityLimiter layer({}, a_robot());
  for (int i = 0; i < 40; ++i) layer.see(observation(1.0 + kTick_s * i, {}, {0.1 * i, 0.0, 0.0}));
  EXPECT_NEAR(layer.limit({0.4, 0.0}).v_mps, CollisionMonitorConfig{}.deaf.silent_mps, 1e-12);
  layer.see(observation(5.0, {.left_m = 3.0}, {4.0, 0.0, 0.0}));
  EXPECT_EQ(layer.limit({0.4, 0.0}).v_mps, 0.4);
}

TEST(VelocityLimiter, AfterABumpThatNobodyHeardComeItCreepsToThatSideUntilAnEchoComesBack) {
  VelocityLimiter layer = layer_that_sees({.left_m = 3.0});
  (void)layer.limit({0.3, 0.0});
  Observation bump = observation(2.0, {.left_m = 3.0});
  bump.bumped = true;
  layer.see(bump);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0) << "first not at all";
  layer.see(observation(8.0, {.left_m = 3.0}, {-0.3, 0.0, 0.0}));
  layer.see(observation(8.0 + kTick_s, {.left_m = 3.0}, {-0.3, 0.0, 0.0}));
  EXPECT_NEAR(layer.limit({0.3, 0.0}).v_mps, 0.04, 1e-12);
  layer.see(observation(8.1, {3.0, kInfinity, 3.0}, {-0.3, 0.0, 0.0}));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

// Whoever predicts echoes may be wrong: it makes the robot slower, never faster.
TEST(VelocityLimiter, WrongExpectationsOnlyEverTakeAway) {
  for (const bool is_expected : {false, true}) {
    VelocityLimiter layer = layer_that_sees({.ahead_m = 0.13});
    listen(layer, 2.0, 10, {.ahead_m = 0.13}, is_expected);
    EXPECT_EQ(layer.limit({0.4, 0.0}).v_mps, 0.0);
  }
}

CollisionMonitorConfig loaded(const std::map<std::string, std::string>& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += key + ": " + value + "\n";
  return load_config<CollisionMonitorConfig>(parse_config_text(text, "mission.yaml"), "collision_monitor");
}

// The laxest that each setting may be, alone and all together.
TEST(VelocityLimiter, NoLegalSettingSwitchesItOff) {
  const std::map<std::string, std::string> laxest{{"margin_m", "0.01"},
                                                  {"slow_m", "0.02"},
                                                  {"stale_s", "0.2"},
                                                  {"blind_s", "1"},
                                                  {"deaf",
                                                   "{rounds: 6, ring_echoes: 12, within_m: 1, "
                                                   "silent_m: 10, silent_mps: 0.1}"}};
  std::vector<std::map<std::string, std::string>> all{laxest};
  for (const auto& setting : laxest) all.push_back({setting});
  for (const auto& settings : all) {
    const CollisionMonitorConfig config = loaded(settings);
    VelocityLimiter wall = layer_that_sees({.ahead_m = 0.13}, a_robot(), config);
    EXPECT_EQ(wall.limit({0.4, 0.0}).v_mps, 0.0);
    VelocityLimiter blind = layer_that_sees({3.0, 3.0, 3.0}, a_robot(), config);
    for (double stamp_s = 1.08; stamp_s < 2.1; stamp_s += kTick_s) blind.see(without_readings(stamp_s));
    EXPECT_EQ(blind.limit({0.4, 0.0}), Twist{});
    VelocityLimiter deaf = layer_that_sees({1.0, 3.0, 3.0}, a_robot(), config);
    listen(deaf, 2.0, 6, {.behind_m = 3.0, .left_m = 3.0}, true);
    EXPECT_NEAR(deaf.limit({0.4, 0.0}).v_mps, 0.04, 1e-12);
  }
}

TEST(VelocityLimiter, SettingsThatWouldSwitchItOffAreRefused) {
  for (const auto& [key, text] : std::vector<std::pair<std::string, std::string>>{{"margin_m", "0"},
                                                                                  {"slow_m", "0"},
                                                                                  {"stale_s", "0"},
                                                                                  {"stale_s", "0.1"},
                                                                                  {"blind_s", "1.5"},
                                                                                  {"blind_s", "10"},
                                                                                  {"deaf", "{rounds: 7}"},
                                                                                  {"deaf", "{silent_mps: 0.2}"},
                                                                                  {"deaf", "{silent_m: 100}"}})
    EXPECT_THROW((void)loaded({{key, text}}), ConfigError) << key << " " << text;
}

// Whatever is wanted, in whatever surroundings: it never speeds up, turns round or leaves the arc.
TEST(VelocityLimiter, OnlyEverTakesAway) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    VelocityLimiter layer = layer_that_sees({1.1 + any(random), 1.1 + any(random), 1.1 + any(random)});
    const Twist wanted{0.4 * any(random), 1.5 * any(random)};
    const Twist allowed = layer.limit(wanted);
    EXPECT_LE(std::abs(allowed.v_mps), std::abs(wanted.v_mps) + 1e-12);
    EXPECT_GE(allowed.v_mps * wanted.v_mps, 0.0);
    EXPECT_LE(std::abs(allowed.w_radps), std::abs(wanted.w_radps) + 1e-12);
    if (allowed.v_mps != 0.0) {
      EXPECT_NEAR(allowed.w_radps / allowed.v_mps, wanted.w_radps / wanted.v_mps, 1e-6);
    }
  }
}

}  // namespace
}  // namespace cairn
