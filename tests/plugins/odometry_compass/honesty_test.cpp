// Is the covariance honest? Many simulated runs with the errors of the shipped robots (docs/method.md 11);
// the normalised estimation error squared of a three-dimensional Gaussian averages 3.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "plugins/odometry_compass/odometry_compass.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr double kTick_s = 0.04;

// A smooth field over the plane with standard normal values, roughly; `bias` is bounded.
class BiasField {
 public:
  BiasField(const CompassError& error, std::mt19937_64& random) : error_(error) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (Wave& wave : waves_) {
      const double direction_rad = 2.0 * std::numbers::pi * unit(random);
      wave.number_radpm =
          (0.5 + unit(random)) / error.local_bias_scale_m * Point(std::cos(direction_rad), std::sin(direction_rad));
      wave.phase_rad = 2.0 * std::numbers::pi * unit(random);
    }
  }
  [[nodiscard]] double bias_rad(const Point& p_m) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::cos(wave.number_radpm.dot(p_m) + wave.phase_rad);
    return error_.local_bias_rad * std::tanh(sum / std::sqrt(0.5 * static_cast<double>(waves_.size())));
  }

 private:
  struct Wave {
    Point number_radpm{0.0, 0.0};
    double phase_rad = 0.0;
  };
  CompassError error_;
  std::array<Wave, 12> waves_;
};

struct Ending {
  double nees = 0.0;
  double position_m = 0.0;
  double heading_rad = 0.0;
};

// Drives about at 0.2 m/s, turning now and then, until the path is long enough.
Ending drive(const RobotModel& robot, double way_m, std::uint64_t seed, bool compass, const Config& config) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Pose2 T_map_start{1.0, 2.0, 0.3};
  const BiasField field(robot.compass_error, random);
  const OdometryError& error = robot.odometry_error;
  const double scale = 1.0 + error.distance_bias_ratio * normal(random);
  Pose2 truth = T_map_start * Pose2{config.start_position_m * normal(random), config.start_position_m * normal(random),
                                    config.start_heading_rad * normal(random)};
  OdometryCompass localizer(config, robot, T_map_start);

  Pose2 T_odom_robot;
  PoseEstimate estimate = localizer.update_by({}, {});
  double turn_radps = 0.0;
  for (double driven_m = 0.0; driven_m < way_m;) {
    if (random() % 100 == 0) turn_radps = 0.4 * normal(random);
    const double step_m = 0.2 * kTick_s;
    const double turn_rad = turn_radps * kTick_s;
    driven_m += step_m;
    truth = truth * Pose2{step_m, 0.0, turn_rad};
    const double counted_m = step_m + config.turn_as_distance_m_per_rad * std::abs(turn_rad);
    T_odom_robot = T_odom_robot * Pose2{scale * step_m + error.distance_ratio * std::sqrt(step_m) * normal(random), 0.0,
                                        turn_rad + error.heading_rad_per_m * std::sqrt(counted_m) * normal(random)};
    Observation observation;
    observation.T_odom_robot = T_odom_robot;
    const double seen_rad =
        truth.theta_rad + field.bias_rad(truth.position()) + robot.compass_error.noise_rad * normal(random);
    if (compass) observation.compass_rad = wrap_angle(seen_rad);
    estimate = localizer.update_by(observation, {});
  }
  Eigen::Vector3d off(truth.x_m - estimate.T_map_robot.x_m, truth.y_m - estimate.T_map_robot.y_m,
                      wrap_angle(truth.theta_rad - estimate.T_map_robot.theta_rad));
  return {off.dot(estimate.covariance.inverse() * off), off.head<2>().norm(), std::abs(off[2])};
}

RobotModel robot_with(const OdometryError& odometry, const CompassError& compass) {
  RobotModel robot;
  robot.odometry_error = odometry;
  robot.compass_error = compass;
  return robot;
}

RobotModel calibrated() {
  return robot_with({0.01, 0.0, radians(0.5)}, {radians(2.0), 0.0, 2.0});
}
RobotModel worn() {
  return robot_with({0.03, 0.02, radians(2.0)}, {radians(2.0), radians(5.0), 2.0});
}

struct Summary {
  double mean_nees = 0.0;
  double median_position_m = 0.0;
  double median_heading_rad = 0.0;
};

Summary many_drives(const RobotModel& robot, bool compass = true, const Config& config = {}) {
  constexpr int kRuns = 100;
  Summary summary;
  std::vector<double> position_m;
  std::vector<double> heading_rad;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Ending ending = drive(robot, 30.0, static_cast<std::uint64_t>(seed), compass, config);
    summary.mean_nees += ending.nees / kRuns;
    position_m.push_back(ending.position_m);
    heading_rad.push_back(ending.heading_rad);
  }
  std::sort(position_m.begin(), position_m.end());
  std::sort(heading_rad.begin(), heading_rad.end());
  summary.median_position_m = position_m[kRuns / 2];
  summary.median_heading_rad = heading_rad[kRuns / 2];
  testing::Test::RecordProperty("mean_nees", std::to_string(summary.mean_nees));
  testing::Test::RecordProperty("median_position_m", std::to_string(summary.median_position_m));
  testing::Test::RecordProperty("median_heading_deg", std::to_string(degrees(summary.median_heading_rad)));
  return summary;
}

TEST(Honesty, HoldsForACalibratedRobot) {
  Config config;
  config.unstated_bias_rad = 0.0;
  const Summary summary = many_drives(calibrated(), true, config);
  EXPECT_GT(summary.mean_nees, 2.0);
  EXPECT_LT(summary.mean_nees, 4.0);
  EXPECT_LT(summary.median_position_m, 0.15);
  EXPECT_LT(summary.median_heading_rad, radians(0.5));
}

TEST(Honesty, HoldsForACompassWhoseBiasIsNotStated) {
  const Summary summary = many_drives(calibrated());
  EXPECT_GT(summary.mean_nees, 1.5);
  EXPECT_LT(summary.mean_nees, 4.0);
  EXPECT_LT(summary.median_heading_rad, radians(2.0));
}

TEST(Honesty, HoldsForAWornRobotWithABiasedCompass) {
  const Summary summary = many_drives(worn());
  EXPECT_GT(summary.mean_nees, 2.0);
  EXPECT_LT(summary.mean_nees, 4.0);
  EXPECT_LT(summary.median_position_m, 0.9);
}

TEST(Honesty, HoldsWithoutACompass) {
  const Summary summary = many_drives(calibrated(), false);
  EXPECT_GT(summary.mean_nees, 2.0);
  EXPECT_LT(summary.mean_nees, 4.0);
}

TEST(Honesty, BeatsOdometryAlone) {
  EXPECT_LT(many_drives(worn()).median_position_m, 0.5 * many_drives(worn(), false).median_position_m);
}

}  // namespace
}  // namespace cairn::odometry_compass
