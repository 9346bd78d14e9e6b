#include "framework/host/stop_layer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "framework/config/config_value.hpp"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTick_s = 0.04;

RangeReading reading(double range_m, double angle_rad = 0.0, int sensor = 0) {
  RangeReading reading;
  reading.T_robot_sensor = {0.1 * std::cos(angle_rad), 0.1 * std::sin(angle_rad), angle_rad};
  reading.half_beam_rad = radians(15.0);
  reading.min_m = 0.1;
  reading.max_m = 5.0;
  reading.range_m = range_m;
  reading.sensor = sensor;
  return reading;
}

// A robot whose transducers look ahead (0), back (1) and to the left (2), and fire all at once.
RobotModel a_robot() {
  RobotModel robot;
  robot.firing_period_s = 0.0;
  return robot;
}

struct Seen {
  double ahead_m = kInfinity;
  double behind_m = kInfinity;
  double left_m = kInfinity;
};

Observation observation(double stamp_s, const Seen& seen = {}, const Pose2& T_odom_robot = {}) {
  Observation o;
  o.stamp_s = stamp_s;
  o.T_odom_robot = T_odom_robot;
  o.ranges = {reading(seen.ahead_m), reading(seen.behind_m, std::numbers::pi, 1),
              reading(seen.left_m, 0.5 * std::numbers::pi, 2)};
  return o;
}

// Standing, with these ranges for two ticks.
StopLayer layer_that_sees(const Seen& seen, const RobotModel& robot = a_robot(), const StopLayerConfig& config = {}) {
  StopLayer layer(config, robot);
  layer.see(observation(1.0, seen));
  layer.see(observation(1.0 + kTick_s, seen));
  return layer;
}

Observation without_readings(double stamp_s) {
  Observation silent;
  silent.stamp_s = stamp_s;
  return silent;
}

TEST(StopLayer, LetsTheRobotGoWhenNothingIsNear) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  EXPECT_EQ(layer.limit({0.3, 0.1}), (Twist{0.3, 0.1}));
  EXPECT_EQ(layer.figures().slowed_s, 0.0);
}

TEST(StopLayer, StopsBeforeAnEchoThatIsAsNearAsTheMargin) {
  StopLayer layer = layer_that_sees({.ahead_m = a_robot().radius_m + 0.05 - 0.1});
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0);
  EXPECT_NEAR(layer.figures().stopped_s, kTick_s, 1e-9);
}

TEST(StopLayer, AlwaysLeavesRoomToReactAndToBrake) {
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

TEST(StopLayer, TheReactionLastsUntilTheTransducerFiresAgain) {
  RobotModel robot = a_robot();
  robot.sonars.resize(7);
  const double at_once = layer_that_sees({.ahead_m = 0.35}).limit({0.4, 0.0}).v_mps;
  robot.firing_period_s = kTick_s;
  const double in_turn = layer_that_sees({.ahead_m = 0.35}, robot).limit({0.4, 0.0}).v_mps;
  EXPECT_LT(in_turn, 0.8 * at_once);
  const double way = 0.35 + 0.1 - robot.radius_m - 0.05;
  EXPECT_LE(in_turn * 8 * kTick_s + in_turn * in_turn / (2.0 * robot.max_acceleration_mps2), way + 1e-9);
}

TEST(StopLayer, GoesSlowlyWhereSomethingIsNear) {
  const RobotModel robot = a_robot();
  StopLayer towards = layer_that_sees({.ahead_m = 0.26});
  EXPECT_NEAR(towards.limit({0.4, 0.0}).v_mps, 0.4 * robot.max_v_mps, 1e-9);
  EXPECT_GT(towards.figures().slowed_s, 0.0);
  EXPECT_EQ(towards.limit({0.1, 0.0}).v_mps, 0.1) << "slow already";
}

TEST(StopLayer, WhatIsBesideTheRobotAlreadyMayBePassedAlong) {
  // Farther than the margin and nearer than the slow zone, as in every narrow door.
  StopLayer layer = layer_that_sees({.ahead_m = 3.0, .left_m = a_robot().radius_m});
  EXPECT_EQ(layer.limit({0.4, 0.0}).v_mps, 0.4);
}

TEST(StopLayer, LooksAlongTheArcNotOnlyStraightAhead) {
  // Something to the left ahead: in the way of a left turn, not of a right one.
  StopLayer layer({.slow_m = 0.02}, a_robot());
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.push_back(reading(0.25, radians(70.0), 3));
    layer.see(o);
  }
  const double straight = layer.limit({0.4, 0.0}).v_mps;
  const double left = layer.limit({0.4, 1.2}).v_mps;
  const double right = layer.limit({0.4, -1.2}).v_mps;
  EXPECT_LT(left, straight);
  EXPECT_EQ(right, 0.4);
}

TEST(StopLayer, SlowingDownKeepsTheArc) {
  StopLayer layer = layer_that_sees({.ahead_m = 0.3});
  const Twist allowed = layer.limit({0.4, 0.2});
  ASSERT_GT(allowed.v_mps, 0.0);
  EXPECT_NEAR(allowed.w_radps / allowed.v_mps, 0.5, 1e-9);
}

TEST(StopLayer, WatchesItsBackToo) {
  StopLayer layer = layer_that_sees({.ahead_m = 3.0, .behind_m = 0.17});
  EXPECT_EQ(layer.limit({-0.3, 0.0}).v_mps, 0.0);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(StopLayer, ADiscMayAlwaysTurnInPlaceAndBackAway) {
  StopLayer layer = layer_that_sees({.ahead_m = 0.12});
  EXPECT_EQ(layer.limit({0.0, 1.0}), (Twist{0.0, 1.0}));
  EXPECT_EQ(layer.limit({-0.2, 0.0}), (Twist{-0.2, 0.0}));
}

TEST(StopLayer, APolygonDoesNotTurnItsCornersIntoWhatItSees) {
  RobotModel robot = a_robot();
  robot.polygon_m = {{-0.4, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.4, 0.15}};
  robot.radius_m = 0.43;
  StopLayer layer({}, robot);
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.push_back(reading(0.27, radians(50.0), 3));  // beside the front left corner
    layer.see(o);
  }
  EXPECT_LT(layer.limit({0.0, 1.0}).w_radps, 0.5);
  EXPECT_EQ(layer.limit({0.0, -0.5}).w_radps, -0.5) << "the other corners are free";
}

TEST(StopLayer, AnEchoBesideTheRobotDoesNotHoldItBack) {
  EXPECT_EQ(layer_that_sees({.ahead_m = 3.0, .left_m = 0.5}).limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(StopLayer, TooNearToMeasureCountsAsTheNearestRange) {
  EXPECT_EQ(layer_that_sees({.ahead_m = -kInfinity}).limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(StopLayer, SilenceDoesNotTakeAnEchoAway) {
  StopLayer layer = layer_that_sees({.ahead_m = 0.17});
  layer.see(observation(1.3));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0) << "a mirror or a dead transducer is silent too";
  layer.see(observation(2.5));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3) << "an old echo no longer counts";
}

TEST(StopLayer, AnEchoFromBehindItTakesAnEchoAway) {
  StopLayer layer = layer_that_sees({.ahead_m = 0.17});
  layer.see(observation(1.1, {.ahead_m = 2.0}));
  EXPECT_GT(layer.limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(StopLayer, StopsEarlierForWhatApproachesByItself) {
  const auto allowed = [](double closing_mps) {
    StopLayer layer({}, a_robot());
    for (int i = 0; i <= 10; ++i)
      layer.see(observation(1.0 + 0.1 * i, {.ahead_m = 0.7 + closing_mps * 0.1 * (10 - i)}));
    return layer.limit({0.4, 0.0}).v_mps;
  };
  EXPECT_GT(allowed(0.0), 0.35);
  EXPECT_LT(allowed(0.5), 0.75 * allowed(0.0));
  EXPECT_LT(allowed(0.9), allowed(0.5));
}

// Also when the cart comes at any speed up to 0.8 m/s, robot and cart on one line.
TEST(StopLayer, FindsTheRobotStandingWhenACartThatDoesNotWaitArrives) {
  for (const double cart_mps : {0.2, 0.5, 0.8}) {
    RobotModel robot = a_robot();
    robot.sonars.resize(7);
    robot.firing_period_s = kTick_s;
    StopLayer layer({}, robot);
    double x_m = 0.0;
    double cart_m = 4.0;
    double v_mps = 0.0;
    for (int tick = 1; cart_m - x_m > robot.radius_m && tick < 1000; ++tick) {
      Observation o;
      o.stamp_s = kTick_s * tick;
      o.T_odom_robot = {x_m, 0.0, 0.0};
      RangeReading r = reading(tick % 7 == 0 ? cart_m - x_m - 0.1 : 4.0, tick % 7 == 0 ? 0.0 : radians(90.0), tick % 7);
      o.ranges = {r};
      layer.see(o);
      const double most = robot.max_acceleration_mps2 * kTick_s;
      v_mps += std::clamp(layer.limit({0.4, 0.0}).v_mps - v_mps, -most, most);
      x_m += v_mps * kTick_s;
      cart_m -= cart_mps * kTick_s;
    }
    EXPECT_LE(v_mps, 0.05) << "cart at " << cart_mps;
    EXPECT_LE(cart_m - x_m, robot.radius_m) << "it has come";
  }
}

TEST(StopLayer, CreepsWhereNoTransducerLooks) {
  StopLayer layer({}, a_robot());
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.erase(o.ranges.begin() + 1);  // none at the back
    layer.see(o);
  }
  EXPECT_EQ(layer.limit({-0.3, 0.0}).v_mps, -0.04);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(StopLayer, CreepsWhereATransducerHasFallenSilent) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  for (double stamp_s = 1.08; stamp_s < 2.6; stamp_s += kTick_s) {
    Observation o = observation(stamp_s, {3.0, 3.0, 3.0});
    o.ranges.erase(o.ranges.begin());
    layer.see(o);
    if (stamp_s < 2.0) {
      EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3) << stamp_s;
    }
  }
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.04);
}

TEST(StopLayer, StopsWithinTwoTicksWithoutReadings) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  layer.see(without_readings(1.08));
  (void)layer.limit({0.3, 0.2});
  layer.see(without_readings(1.12));
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
  EXPECT_DOUBLE_EQ(layer.figures().stale_s, 1.12 - 1.08);
  layer.see(observation(1.16, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.2}), (Twist{0.3, 0.2}));
}

TEST(StopLayer, AReadingThatIsNoNumberIsNoReading) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  layer.see(observation(1.08, {nan, nan, nan}));
  layer.see(observation(1.12, {nan, nan, nan}));
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
}

// Also for a moment only: what it has seen in a frame that is lost may be anywhere.
TEST(StopLayer, OdometryThatIsNoNumberIsStale) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
    for (const Pose2& T_odom_robot : {Pose2{bad, 0.0, 0.0}, Pose2{0.0, bad, 0.0}, Pose2{0.0, 0.0, bad}}) {
      StopLayer layer = layer_that_sees({.ahead_m = 0.17});
      layer.see(observation(1.08, {.ahead_m = 0.17}, T_odom_robot));
      EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
      EXPECT_GT(layer.figures().stale_s, 0.0);
      layer.see(without_readings(1.10));
      EXPECT_LE(layer.limit({0.3, 0.0}).v_mps, 0.04) << "nobody has looked since";
      layer.see(observation(1.12, {.ahead_m = 0.17}));
      EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0);
    }
  }
}

TEST(StopLayer, AReadingFromNoPlaceIsNoReading) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  for (const double stamp_s : {1.08, 1.12}) {
    Observation o = observation(stamp_s, {0.17, 3.0, 3.0});
    o.ranges[0].T_robot_sensor.x_m = o.ranges[1].T_robot_sensor.theta_rad = o.ranges[2].half_beam_rad = nan;
    layer.see(o);
  }
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
}

TEST(StopLayer, AClockThatStandsStillOrJumpsBackIsStale) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  layer.see(observation(1.04, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.0}), Twist{});
  layer.see(observation(0.5, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.0}), Twist{});
  layer.see(observation(std::numeric_limits<double>::quiet_NaN(), {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.0}), Twist{});
  layer.see(observation(0.54, {3.0, 3.0, 3.0}));
  layer.see(observation(0.58, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3) << "time goes on from there";
}

TEST(StopLayer, ABumpStopsMotionTowardsItsSide) {
  StopLayer layer = layer_that_sees({3.0, 3.0, 3.0});
  (void)layer.limit({0.2, 0.0});
  Observation bump = observation(1.08, {3.0, 3.0, 3.0});
  bump.bumped = true;
  layer.see(bump);
  EXPECT_EQ(layer.limit({0.2, 0.0}).v_mps, 0.0);
  EXPECT_EQ(layer.limit({-0.2, 0.0}).v_mps, -0.04) << "creeps away from it";
  EXPECT_EQ(layer.limit({0.0, 1.0}).w_radps, 1.0);
  layer.see(observation(1.12, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.2, 0.0}).v_mps, 0.0) << "still there";
  layer.see(observation(1.2, {3.0, 3.0, 3.0}, {-0.3, 0.0, 0.0}));
  EXPECT_GT(layer.limit({0.2, 0.0}).v_mps, 0.0) << "there is room again";
}

TEST(StopLayer, KeepsToTheRobotsLimitsAndRefusesWhatIsNoNumber) {
  const RobotModel robot = a_robot();
  StopLayer layer = layer_that_sees({4.0, 4.0, 4.0});
  EXPECT_EQ(layer.limit({9.0, -9.0}), (Twist{robot.max_v_mps, -robot.max_w_radps}));
  EXPECT_EQ(layer.limit({std::numeric_limits<double>::quiet_NaN(), 0.0}), Twist{});
}

StopLayerConfig loaded(const std::map<std::string, std::string>& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += key + ": " + value + "\n";
  return load_config<StopLayerConfig>(parse_config_text(text, "mission.yaml"), "stop_layer");
}

// The laxest that each setting may be, alone and all together.
TEST(StopLayer, NoLegalSettingSwitchesItOff) {
  const std::map<std::string, std::string> laxest{
      {"margin_m", "0.01"}, {"slow_m", "0.02"}, {"stale_s", "0.2"}, {"blind_s", "1"}};
  std::vector<std::map<std::string, std::string>> all{laxest};
  for (const auto& setting : laxest) all.push_back({setting});
  for (const auto& settings : all) {
    const StopLayerConfig config = loaded(settings);
    StopLayer wall = layer_that_sees({.ahead_m = 0.13}, a_robot(), config);
    EXPECT_EQ(wall.limit({0.4, 0.0}).v_mps, 0.0);
    StopLayer blind = layer_that_sees({3.0, 3.0, 3.0}, a_robot(), config);
    for (double stamp_s = 1.08; stamp_s < 2.1; stamp_s += kTick_s) blind.see(without_readings(stamp_s));
    EXPECT_EQ(blind.limit({0.4, 0.0}), Twist{});
  }
}

TEST(StopLayer, SettingsThatWouldSwitchItOffAreRefused) {
  for (const auto& [key, text] : std::vector<std::pair<std::string, std::string>>{{"margin_m", "0"},
                                                                                  {"slow_m", "0"},
                                                                                  {"stale_s", "0"},
                                                                                  {"stale_s", "0.1"},
                                                                                  {"blind_s", "1.5"},
                                                                                  {"blind_s", "10"}})
    EXPECT_THROW((void)loaded({{key, text}}), ConfigError) << key << " " << text;
}

// Whatever is wanted, in whatever surroundings: it never speeds up, turns round or leaves the arc.
TEST(StopLayer, OnlyEverTakesAway) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    StopLayer layer = layer_that_sees({1.1 + any(random), 1.1 + any(random), 1.1 + any(random)});
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
