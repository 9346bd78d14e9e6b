#include "plugins/simulated_robot/laser_scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plugins/simulated_robot/simulated_robot.hpp"

namespace cairn {
namespace {

World cluttered_world() {
  World world;
  world.min_m = {0.0, 0.0};
  world.max_m = {8.0, 6.0};
  world.walls.push_back({{{0, 0}, {8, 0}, {8, 6}, {0, 6}, {0, 0}}, Surface::smooth});
  world.walls.push_back({{{3, 0}, {3, 2.4}}, Surface::rough});
  world.walls.push_back({{{3, 3.3}, {3, 6}}, Surface::smooth});
  world.objects.push_back({"", Contour::circle(0.6), {1.5, 4.5, 0.0}, Surface::smooth});
  world.objects.push_back({"",
                           Contour::polygon_in_place({{0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.3, -0.2}}),
                           {5.5, 2.0, 0.4},
                           Surface::rough});
  return world;
}

LaserModel laser(int beams, double first_deg, double last_deg, double rate_hz = 20.0) {
  LaserModel model;
  model.first_angle_rad = radians(first_deg);
  model.last_angle_rad = radians(last_deg);
  model.beams = beams;
  model.rate_hz = rate_hz;
  model.noise_m = 0.0;
  return model;
}

RobotModel robot_with(std::vector<LaserModel> lasers) {
  RobotModel robot;
  robot.radius_m = 0.2;
  robot.lasers = std::move(lasers);
  return robot;
}

TEST(LaserScanner, AFanReadsWhatEachRayReadsByItself) {
  const Scene scene(cluttered_world());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    const Point from_m(8.0 * unit(random), 6.0 * unit(random));
    const double step_rad = (unit(random) < 0.5 ? -1.0 : 1.0) * radians(0.2 + 7.0 * unit(random));
    const auto rays = std::min<std::size_t>(2 + random() % 90, static_cast<std::size_t>(6.28 / std::abs(step_rad)) + 1);
    const RayFan fan{from_m, radians(720.0 * (unit(random) - 0.5)), step_rad, 0.5 + 7.0 * unit(random)};
    std::vector<double> distances_m(rays);
    scene.cast_fan(fan, distances_m);
    for (std::size_t i = 0; i < rays; ++i) {
      const double bearing_rad = fan.first_rad + static_cast<double>(i) * fan.step_rad;
      const double alone_m = scene.cast(from_m, {std::cos(bearing_rad), std::sin(bearing_rad)}, fan.reach_m).distance_m;
      EXPECT_EQ(distances_m[i], alone_m) << "round " << round << ", ray " << i;
    }
  }
}

TEST(LaserScanner, ItsBeamsAreThinAndNumberedAfterTheSonars) {
  RobotModel robot = robot_with({laser(3, -90, 90), laser(2, -10, 10)});
  robot.sonars.resize(2);
  robot.lasers[1].T_robot_laser = {0.0, 0.1, radians(180.0)};
  const Scene scene(cluttered_world());
  LaserScanners scanners(robot, scene, 1);
  std::vector<RangeReading> seen;
  scanners.scan({1.0, 1.0, 0.0}, 0.0, 0.05, seen);
  ASSERT_EQ(seen.size(), 5U);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].sensor, 2 + static_cast<int>(i));
    EXPECT_EQ(seen[i].half_beam_rad, 0.0);
  }
  EXPECT_NEAR(seen[0].range_m, 1.0, 1e-9) << "the wall to the right";
  EXPECT_NEAR(seen[1].range_m, 2.0, 1e-9) << "ahead";
  EXPECT_NEAR(degrees(seen[3].T_robot_sensor.theta_rad), 170.0, 1e-9);
}

TEST(LaserScanner, NeitherSlantNorSmoothnessLosesAnEcho) {
  const Scene scene(cluttered_world());
  std::vector<LaserModel> lasers{laser(61, -5, 85)};
  lasers[0].max_m = 12.0;
  LaserScanners scanners(robot_with(lasers), scene, 1);
  std::vector<RangeReading> seen;
  scanners.scan({0.3, 0.3, 0.0}, 0.0, 0.05, seen);
  for (const RangeReading& reading : seen) EXPECT_TRUE(std::isfinite(reading.range_m)) << reading.sensor;
}

TEST(LaserScanner, BeyondItsRangeItReadsNothingAndNearerThanItsLeastTooNear) {
  std::vector<LaserModel> lasers{laser(1, 0, 0)};
  lasers[0].min_m = 0.5;
  lasers[0].max_m = 1.5;
  const Scene scene(cluttered_world());
  LaserScanners scanners(robot_with(lasers), scene, 1);
  const auto read = [&](double x_m) {
    std::vector<RangeReading> seen;
    scanners.scan({x_m, 1.0, 0.0}, 0.0, 0.05, seen);
    return seen.at(0).range_m;
  };
  EXPECT_EQ(read(1.0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(read(2.0), 1.0, 1e-9);
  EXPECT_EQ(read(2.7), -std::numeric_limits<double>::infinity());
}

TEST(LaserScanner, EachComesAtItsOwnRate) {
  const World world = cluttered_world();
  SimulatedRobotConfig config;
  config.tick_s = 0.02;
  SimulatedRobot robot(config, robot_with({laser(3, -90, 90, 10.0), laser(2, -10, 10, 25.0)}), &world, {1, 1, 0}, 3);
  int slow = 0;
  int fast = 0;
  for (double stamp_s = 0.0; stamp_s < 1.99;) {
    const Observation seen = robot.next({}).observation;
    EXPECT_NEAR(seen.stamp_s - stamp_s, 0.02, 1e-9) << "the fast one's period in two";
    stamp_s = seen.stamp_s;
    for (const RangeReading& reading : seen.ranges) ++(reading.sensor < 3 ? slow : fast);
  }
  EXPECT_EQ(slow, 3 * 20);
  EXPECT_EQ(fast, 2 * 50);
}

TEST(LaserScanner, ATickIsAWholePartOfItsPeriod) {
  EXPECT_DOUBLE_EQ(laser_tick_s(robot_with({laser(3, -90, 90, 20.0)}), 0.05), 0.05);
  EXPECT_DOUBLE_EQ(laser_tick_s(robot_with({laser(3, -90, 90, 20.0)}), 0.04), 0.025);
  EXPECT_DOUBLE_EQ(laser_tick_s(robot_with({laser(3, -90, 90, 5.0)}), 0.04), 0.04);
  EXPECT_DOUBLE_EQ(laser_tick_s(robot_with({laser(3, -90, 90, 100.0)}), 0.04), 0.01);
}

TEST(LaserScanner, TheSonarsBesideItReadWhatTheyReadWithoutIt) {
  const World world = cluttered_world();
  RobotModel plain;
  plain.radius_m = 0.2;
  plain.sonars.resize(3);
  plain.sonars[1].T_robot_sonar.theta_rad = 1.0;
  RobotModel both = plain;
  both.lasers = {laser(9, -90, 90)};
  SimulatedRobot alone({}, plain, &world, {1, 1, 0}, 3);
  SimulatedRobot beside({}, both, &world, {1, 1, 0}, 3);
  bool has_scanned = false;
  for (int i = 0; i < 30; ++i) {
    const Observation a = alone.next({}).observation;
    const Observation b = beside.next({}).observation;
    ASSERT_EQ(a.ranges.size(), 1U);
    ASSERT_FALSE(b.ranges.empty());
    EXPECT_EQ(a.ranges[0].range_m, b.ranges[0].range_m);
    has_scanned = has_scanned || b.ranges.size() == 10U;
  }
  EXPECT_TRUE(has_scanned);
}

TEST(LaserScanner, ItsNoiseIsAsStated) {
  std::vector<LaserModel> lasers{laser(1000, -0.001, 0.001)};
  lasers[0].noise_m = 0.02;
  lasers[0].dropped_ratio = 0.1;
  const Scene scene(cluttered_world());
  LaserScanners scanners(robot_with(lasers), scene, 1);
  std::vector<RangeReading> seen;
  scanners.scan({1.0, 1.0, 0.0}, 0.0, 0.05, seen);
  int lost = 0;
  double squares = 0.0;
  for (const RangeReading& reading : seen)
    std::isfinite(reading.range_m) ? static_cast<void>(squares += std::pow(reading.range_m - 2.0, 2))
                                   : static_cast<void>(++lost);
  EXPECT_NEAR(lost, 100, 30);
  EXPECT_NEAR(std::sqrt(squares / (1000 - lost)), 0.02, 0.002);
}

}  // namespace
}  // namespace cairn
