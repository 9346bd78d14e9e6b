// What the stop layer takes for a reading, for how long it believes it, and what it does without any.

#include <gtest/gtest.h>

#include "tests/framework/safety/velocity_limiter_scenes.hpp"

namespace cairn {
namespace {

TEST(VelocityLimiter, TooNearToMeasureCountsAsTheNearestRange) {
  EXPECT_EQ(layer_that_sees({.ahead_m = -kInfinity}).limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(VelocityLimiter, SilenceDoesNotTakeAnEchoAway) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = 0.17});
  layer.see(observation(1.3));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0) << "a mirror or a dead transducer is silent too";
  layer.see(observation(2.5));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3) << "an old echo no longer counts";
}

TEST(VelocityLimiter, AnEchoFromBehindItTakesAnEchoAway) {
  VelocityLimiter layer = layer_that_sees({.ahead_m = 0.17});
  layer.see(observation(1.1, {.ahead_m = 2.0}));
  EXPECT_GT(layer.limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(VelocityLimiter, StopsEarlierForWhatApproachesByItself) {
  const auto allowed = [](double closing_mps) {
    VelocityLimiter layer({}, a_robot());
    for (int i = 0; i <= 10; ++i)
      layer.see(observation(1.0 + 0.1 * i, {.ahead_m = 0.7 + closing_mps * 0.1 * (10 - i)}));
    return layer.limit({0.4, 0.0}).v_mps;
  };
  EXPECT_GT(allowed(0.0), 0.35);
  EXPECT_LT(allowed(0.5), 0.75 * allowed(0.0));
  EXPECT_LT(allowed(0.9), allowed(0.5));
}

// Also when the cart comes at any speed up to 0.8 m/s, robot and cart on one line.
TEST(VelocityLimiter, FindsTheRobotStandingWhenACartThatDoesNotWaitArrives) {
  for (const double cart_mps : {0.2, 0.5, 0.8}) {
    RobotModel robot = a_robot();
    robot.sonars.resize(7);
    robot.firing_period_s = kTick_s;
    VelocityLimiter layer({}, robot);
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

TEST(VelocityLimiter, CreepsWhereNoTransducerLooks) {
  VelocityLimiter layer({}, a_robot());
  for (const double stamp_s : {1.0, 1.04}) {
    Observation o = observation(stamp_s);
    o.ranges.erase(o.ranges.begin() + 1);  // none at the back
    layer.see(o);
  }
  EXPECT_EQ(layer.limit({-0.3, 0.0}).v_mps, -0.04);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(VelocityLimiter, CreepsWhereATransducerHasFallenSilent) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
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

TEST(VelocityLimiter, StopsWithinTwoTicksWithoutReadings) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
  layer.see(without_readings(1.08));
  (void)layer.limit({0.3, 0.2});
  layer.see(without_readings(1.12));
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
  EXPECT_DOUBLE_EQ(layer.figures().stale_s, 1.12 - 1.08);
  layer.see(observation(1.16, {3.0, 3.0, 3.0}));
  EXPECT_EQ(layer.limit({0.3, 0.2}), (Twist{0.3, 0.2}));
}

// Seconds of ten in which a robot with readings every read_s and odometry every odometry_s, each by itself, is let go.
double let_go_s(double odometry_s, double read_s, double jitter_s) {
  VelocityLimiter layer({}, a_robot());
  const int every = static_cast<int>(std::lround(read_s / odometry_s));
  double gone_s = 0.0;
  for (int tick = 1; tick * odometry_s < 10.0; ++tick) {
    const double late_s = tick == 20 ? jitter_s : 0.0;  // the one before comes as late as that
    const double stamp_s = 1.0 + tick * odometry_s;
    layer.see(tick % every == 0 ? observation(stamp_s, {3.0, 3.0, 3.0}) : without_readings(stamp_s));
    if (late_s > 0.0) layer.see(observation(stamp_s + late_s, {3.0, 3.0, 3.0}));
    if (layer.limit({0.3, 0.0}) != Twist{}) gone_s += odometry_s;
  }
  return gone_s;
}

TEST(VelocityLimiter, MeasuresThePeriodOfReadingsNotOfOdometry) {
  EXPECT_GT(let_go_s(0.02, 0.1, 0.0), 9.7) << "only the first readings say how often they come";
  EXPECT_GT(let_go_s(0.04, 0.04, 0.0), 9.7);
}

TEST(VelocityLimiter, OneStampThatJittersDoesNotBlindItForGood) {
  EXPECT_GT(let_go_s(0.02, 0.1, 0.001), 9.6);
  EXPECT_GT(let_go_s(0.04, 0.04, 0.001), 9.6);
}

TEST(VelocityLimiter, ReadingsThatHaveBeenMissingOnceDoNotMakeItPatient) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
  double stamp_s = 1.0 + kTick_s;
  for (int i = 0; i < 20; ++i) layer.see(observation(stamp_s += kTick_s, {3.0, 3.0, 3.0}));
  layer.see(observation(stamp_s += 3.0, {3.0, 3.0, 3.0}));
  layer.see(observation(stamp_s += kTick_s, {3.0, 3.0, 3.0}));
  for (int i = 0; i < 2; ++i) layer.see(without_readings(stamp_s += kTick_s));
  EXPECT_EQ(layer.limit({0.3, 0.0}), Twist{});
}

TEST(VelocityLimiter, AReadingThatIsNoNumberIsNoReading) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  layer.see(observation(1.08, {nan, nan, nan}));
  layer.see(observation(1.12, {nan, nan, nan}));
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
}

// Also for a moment only: what it has seen in a frame that is lost may be anywhere.
TEST(VelocityLimiter, OdometryThatIsNoNumberIsStale) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
    for (const Pose2& T_odom_robot : {Pose2{bad, 0.0, 0.0}, Pose2{0.0, bad, 0.0}, Pose2{0.0, 0.0, bad}}) {
      VelocityLimiter layer = layer_that_sees({.ahead_m = 0.17});
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

TEST(VelocityLimiter, AReadingFromNoPlaceIsNoReading) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
  for (const double stamp_s : {1.08, 1.12}) {
    Observation o = observation(stamp_s, {0.17, 3.0, 3.0});
    o.ranges[0].T_robot_sensor.x_m = o.ranges[1].T_robot_sensor.theta_rad = o.ranges[2].half_beam_rad = nan;
    layer.see(o);
  }
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
}

TEST(VelocityLimiter, AClockThatStandsStillOrJumpsBackIsStale) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
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

TEST(VelocityLimiter, ABumpStopsMotionTowardsItsSide) {
  VelocityLimiter layer = layer_that_sees({3.0, 3.0, 3.0});
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

}  // namespace
}  // namespace cairn
