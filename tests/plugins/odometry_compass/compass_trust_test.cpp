#include "plugins/odometry_compass/compass_trust.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "plugins/odometry_compass/odometry_compass.hpp"

namespace cairn::odometry_compass {
namespace {

double estimated_noise_rad(double stated_rad, double true_rad, int readings, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, true_rad);
  CompassNoise noise(stated_rad);
  double before_rad = normal(random);
  for (int i = 0; i < readings; ++i) {
    const double here_rad = normal(random);
    noise.add(here_rad - before_rad);
    before_rad = here_rad;
  }
  return noise.deviation_rad();
}

TEST(CompassNoise, FindsThreeTimesTheStatedNoiseWithinFiveSeconds) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_NEAR(estimated_noise_rad(radians(2.0), radians(6.0), 125, seed), radians(6.0), radians(1.5)) << seed;
}

TEST(CompassNoise, FindsNoiseThatTheFileDoesNotState) {
  EXPECT_NEAR(estimated_noise_rad(radians(0.5), radians(6.0), 1000, 1), radians(6.0), radians(0.6));
}

TEST(CompassNoise, IsNeverLessThanTheFileStates) {
  EXPECT_EQ(estimated_noise_rad(radians(2.0), radians(0.1), 1000, 1), radians(2.0));
}

TEST(CompassNoise, HardlyRisesWithOneJump) {
  CompassNoise noise(radians(2.0));
  noise.add(radians(90.0));
  EXPECT_LT(noise.deviation_rad(), radians(2.5));
}

TEST(CompassDrift, SeparatesWhatCreepsFromNoise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  CompassDrift noise;
  for (int i = 0; i < 2000; ++i) {
    noise.add(normal(random));
    ASSERT_FALSE(noise.is_fast(4.5) || noise.is_slow(4.5)) << i;
  }
  CompassDrift creeping;
  for (int i = 0; i < 200; ++i) creeping.add(0.8 + normal(random));
  EXPECT_TRUE(creeping.is_slow(4.5));
  creeping.restart();
  EXPECT_FALSE(creeping.is_slow(0.1));
}

constexpr double kTick_s = 0.04;
const Point kRoom_m{6.0, 5.0};

// Eight sonars all round, without noise of their own.
RobotModel robot_in_room() {
  RobotModel robot;
  robot.odometry_error = {0.01, 0.0, radians(0.5)};
  robot.compass_error = {radians(2.0), 0.0, 2.0};
  return robot;
}

// What a wide beam hears of the four walls: the nearest foot of a perpendicular in it.
RangeReading heard(const Pose2& T_map_robot, double angle_rad) {
  RangeReading reading;
  reading.T_robot_sensor = {0.1 * std::cos(angle_rad), 0.1 * std::sin(angle_rad), angle_rad};
  reading.half_beam_rad = radians(15.0);
  reading.max_m = 5.0;
  reading.range_m = 5.0;
  const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
  const double distances_m[] = {kRoom_m.x() - T_map_sensor.x_m, kRoom_m.y() - T_map_sensor.y_m, T_map_sensor.x_m,
                                T_map_sensor.y_m};
  for (int wall = 0; wall < 4; ++wall)
    if (std::abs(wrap_angle(0.5 * std::numbers::pi * wall - T_map_sensor.theta_rad)) < reading.half_beam_rad)
      reading.range_m = std::min(reading.range_m, distances_m[wall]);
  return reading;
}

struct Disturbance {
  double noise_rad = radians(2.0);  // of the compass, in truth
  std::function<double(const Point&)> bias_rad = [](const Point&) { return 0.0; };
  double heading_rad_per_m = radians(0.5);  // of the odometry, in truth
  double slip_from_m = 1e9;                 // the left wheel slips for a quarter of a metre
};

struct Errors {
  double worst_rad = 0.0;
  double worst_later_rad = 0.0;  // from the second side on
  double last_rad = 0.0;
  double last_m = 0.0;
};

// Two rounds along the walls.
Errors drive_round(const RobotModel& robot, const Disturbance& disturbance, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Pose2 truth{1.0, 1.0, 0.0};
  OdometryCompass localizer({}, robot, truth);
  Pose2 T_odom_robot;
  Errors errors;
  double driven_m = 0.0;
  int ticks = 0;
  const auto step = [&](double along_m, double turn_rad) {
    const bool slips = driven_m > disturbance.slip_from_m && driven_m < disturbance.slip_from_m + 0.25;
    const double lost_m = slips ? 0.3 * along_m : 0.0;
    driven_m += along_m;
    truth = truth * Pose2{along_m - lost_m, 0.0, turn_rad + lost_m / robot.radius_m};
    const double counted_m = along_m + 0.1 * std::abs(turn_rad);
    T_odom_robot =
        T_odom_robot *
        Pose2{along_m, 0.0, turn_rad + disturbance.heading_rad_per_m * std::sqrt(counted_m) * normal(random)};
    Observation seen;
    seen.stamp_s = kTick_s * ++ticks;
    seen.T_odom_robot = T_odom_robot;
    seen.compass_rad =
        wrap_angle(truth.theta_rad + disturbance.bias_rad(truth.position()) + disturbance.noise_rad * normal(random));
    for (int sonar = 0; sonar < 8; ++sonar) seen.ranges.push_back(heard(truth, radians(45.0) * sonar));
    const Pose2 estimate = localizer.update_by(seen, {}).T_map_robot;
    errors.last_rad = std::abs(wrap_angle(estimate.theta_rad - truth.theta_rad));
    errors.worst_rad = std::max(errors.worst_rad, errors.last_rad);
    if (driven_m > 4.0) errors.worst_later_rad = std::max(errors.worst_later_rad, errors.last_rad);
    errors.last_m = (estimate.position() - truth.position()).norm();
  };
  for (int side = 0; side < 8; ++side) {
    for (int i = 0; i < (side % 2 == 0 ? 400 : 300); ++i) step(0.01, 0.0);
    for (int i = 0; i < 45; ++i) step(0.0, radians(2.0));
  }
  return errors;
}

TEST(CompassInARoom, ThreeTimesTheNoiseThatTheFileStatesIsNoSlip) {
  Disturbance noisy;
  noisy.noise_rad = radians(6.0);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Errors errors = drive_round(robot_in_room(), noisy, seed);
    EXPECT_LT(errors.worst_rad, radians(3.0)) << seed;
    EXPECT_LT(errors.last_m, 0.1) << seed;
  }
}

TEST(CompassInARoom, WallsStandAgainstABiasThatTheFileDoesNotState) {
  Disturbance biased;
  biased.bias_rad = [](const Point& p) { return radians(15.0) * std::sin(p.x() - 1.0) * std::cos(0.7 * p.y() - 0.7); };
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Errors errors = drive_round(robot_in_room(), biased, seed);
    EXPECT_LT(errors.worst_later_rad, radians(5.0)) << seed;
    EXPECT_LT(errors.last_m, 0.15) << seed;
  }
}

TEST(CompassInARoom, SaysSoFromTheBeginningWhereTheRobotStandsOnSteel) {
  Disturbance biased;
  biased.bias_rad = [](const Point& p) { return radians(12.0) * std::cos(p.x() - 1.0); };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Errors errors = drive_round(robot_in_room(), biased, seed);
    EXPECT_LT(errors.worst_rad, radians(5.0)) << seed;
    EXPECT_LT(errors.last_m, 0.15) << seed;
  }
}

TEST(CompassInARoom, WheelsThatTurnItTenTimesAsMuchAsTheFileStatesAreHeldByIt) {
  Disturbance worn;
  worn.heading_rad_per_m = radians(5.0);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Errors errors = drive_round(robot_in_room(), worn, seed);
    EXPECT_LT(errors.worst_rad, radians(10.0)) << seed;
    EXPECT_LT(errors.last_m, 0.3) << seed;
  }
}

TEST(CompassInARoom, ASlipIsFoundWhereWallsBearItOut) {
  Disturbance slip;
  slip.slip_from_m = 5.0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Errors errors = drive_round(robot_in_room(), slip, seed);
    EXPECT_GT(errors.worst_rad, radians(3.0)) << "the slip is there";
    EXPECT_LT(errors.last_rad, radians(2.0)) << seed;
    EXPECT_LT(errors.last_m, 0.15) << seed;
  }
}

TEST(CompassInARoom, WithoutOneInTheRobotsFileItsReadingsAreNotUsed) {
  RobotModel robot = robot_in_room();
  robot.has_compass = false;
  Disturbance wrong;
  wrong.bias_rad = [](const Point&) { return 2.0; };
  EXPECT_LT(drive_round(robot, wrong, 1).worst_rad, radians(5.0));
}

}  // namespace
}  // namespace cairn::odometry_compass
