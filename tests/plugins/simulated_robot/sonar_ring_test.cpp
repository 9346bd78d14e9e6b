#include "plugins/simulated_robot/sonar_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace cairn {
namespace {

RobotModel robot_with_sonars(int count) {
  RobotModel robot;
  for (int i = 0; i < count; ++i) robot.sonars.push_back({{0.0, 0.0, 0.1 * i}, radians(15.0), 0.1, 3.0});
  robot.firing_period_s = 0.04;
  return robot;
}

std::vector<int> sensors_of(const std::vector<RangeReading>& readings) {
  std::vector<int> sensors;
  for (const RangeReading& reading : readings) sensors.push_back(reading.sensor);
  return sensors;
}

TEST(SonarRing, FiresOneTransducerATickInTheFiringOrder) {
  RobotModel robot = robot_with_sonars(3);
  robot.firing_order = {2, 0, 1};
  const Scene scene{World{}};
  SonarRing ring({}, robot, scene, 1);
  std::vector<int> order;
  for (int tick = 1; tick <= 4; ++tick) order.push_back(ring.fire({}, tick).at(0).sensor);
  EXPECT_EQ(order, (std::vector<int>{2, 0, 1, 2}));
}

TEST(SonarRing, FiresAllAtOnceWhenAskedToOrWithoutAFiringPeriod) {
  RobotModel robot = robot_with_sonars(3);
  const Scene scene{World{}};
  SimulatedRobotConfig config;
  config.fire_all = true;
  EXPECT_EQ(sensors_of(SonarRing(config, robot, scene, 1).fire({}, 1)), (std::vector<int>{0, 1, 2}));
  robot.firing_period_s = 0.0;
  EXPECT_EQ(sensors_of(SonarRing({}, robot, scene, 1).fire({}, 1)), (std::vector<int>{0, 1, 2}));
}

TEST(SonarRing, ReadsInfinityWhereNothingEchoes) {
  const Scene scene{World{}};
  const std::vector<RangeReading> readings = SonarRing({}, robot_with_sonars(1), scene, 1).fire({}, 1);
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_TRUE(std::isinf(readings[0].range_m));
}

TEST(SonarRing, HearsWithItsTrueBeamAndStatesThatOfTheFile) {
  RobotModel robot = robot_with_sonars(1);
  robot.range_error = {0.0, 0.0, 0.0, 0.0};
  World world;
  const Pose2 beside{1.5 * std::cos(radians(30.0)), 1.5 * std::sin(radians(30.0)), 0.0};
  world.objects = {{"", Contour::circle(0.4), beside, Surface::rough}};
  const Scene scene{world};
  SimulatedRobotConfig config;
  EXPECT_TRUE(std::isinf(SonarRing(config, robot, scene, 1).fire({}, 1).at(0).range_m));
  config.truth.half_beam_rad = radians(45.0);
  const RangeReading reading = SonarRing(config, robot, scene, 1).fire({}, 1).at(0);
  EXPECT_NEAR(reading.range_m, 1.3, 1e-6);
  EXPECT_DOUBLE_EQ(reading.half_beam_rad, radians(15.0));
}

TEST(SonarRing, LosesEchoesAsOftenAsInTruth) {
  RobotModel robot = robot_with_sonars(1);
  robot.range_error = {0.0, 0.0, 0.0, 0.0};
  World world;
  world.objects = {{"", Contour::circle(0.4), {1.0, 0.0, 0.0}, Surface::rough}};
  const Scene scene{world};
  SimulatedRobotConfig config;
  config.truth.ranges.dropped_ratio = 1.0;
  EXPECT_NEAR(SonarRing({}, robot, scene, 1).fire({}, 1).at(0).range_m, 0.8, 1e-9);
  EXPECT_TRUE(std::isinf(SonarRing(config, robot, scene, 1).fire({}, 1).at(0).range_m));
}

TEST(TrueRobot, IsTheFilesWhereNothingElseIsSaid) {
  RobotModel robot = robot_with_sonars(2);
  robot.odometry_error = {0.01, 0.02, 0.03};
  robot.compass_error = {0.04, 0.05, 1.5};
  TruthConfig truth;
  truth.odometry.distance_ratio = 0.1;
  truth.compass.local_bias_rad = 0.2;
  const RobotModel real = in_truth(robot, truth);
  EXPECT_EQ(real.odometry_error.distance_ratio, 0.1);
  EXPECT_EQ(real.odometry_error.distance_bias_ratio, 0.02);
  EXPECT_EQ(real.odometry_error.heading_rad_per_m, 0.03);
  EXPECT_EQ(real.compass_error.noise_rad, 0.04);
  EXPECT_EQ(real.compass_error.local_bias_rad, 0.2);
  EXPECT_EQ(real.compass_error.local_bias_scale_m, 1.5);
  EXPECT_EQ(real.sonars[1].half_beam_rad, radians(15.0));
  EXPECT_EQ(real.range_error.noise_m, robot.range_error.noise_m);
}

TEST(SonarRing, RefusesAFiringOrderThatNamesNoSonarOfTheRobot) {
  RobotModel robot = robot_with_sonars(2);
  robot.firing_order = {0, 2};
  const Scene scene{World{}};
  EXPECT_THROW(SonarRing({}, robot, scene, 1), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
