#include "plugins/submap_graph/compass_headings.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "plugins/submap_graph/laser_graph.hpp"
#include "tests/plugins/submap_graph/driven_ring.hpp"

namespace cairn::submap_graph {
namespace {

const Compass kCompass{radians(2.0), radians(30.0), radians(3.0), 4.0};

Config gathering() {
  Config config;
  config.gather_m = 5.0;
  config.odometry_ratio = 0.05;
  config.odometry_rad_per_m = radians(2.0);
  return config;
}

// Without an echo, so without a closure. bias: of the compass, by the way.
template <class Bias>
std::vector<Pose2> driven(const std::vector<DrivenScan>& drive, const Compass& compass, Bias bias_rad) {
  LaserGraph graph(gathering(), drive.front().T_map_robot, nullptr, compass);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, radians(2.0));
  double stamp_s = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i)
    graph.add({}, drive[i].T_odom_robot, stamp_s += 0.5,
              wrap_angle(drive[i].T_map_robot.theta_rad + bias_rad(0.3 * static_cast<double>(i)) + noise(random)));
  while (graph.finish_part()) {
  }
  return graph.poses();
}

double worst_turn_rad(const std::vector<Pose2>& poses, const std::vector<DrivenScan>& drive) {
  double worst_rad = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i)
    worst_rad = std::max(worst_rad, std::abs(wrap_angle(poses[i].theta_rad - drive[i].T_map_robot.theta_rad)));
  return worst_rad;
}

TEST(CompassHeadings, ARobotWithoutCompassHasNone) {
  RobotModel robot;
  EXPECT_GT(compass_of({}, robot).noise_rad, 0.0);
  Config without;
  without.use_compass = false;
  EXPECT_EQ(compass_of(without, robot).noise_rad, 0.0);
  robot.has_compass = false;
  EXPECT_EQ(compass_of({}, robot).noise_rad, 0.0);
}

TEST(CompassHeadings, TheFileMaySayMoreThanTheSettingsAndNotLess) {
  RobotModel robot;
  robot.compass_error = {radians(0.1), 0.0, 2.0};
  EXPECT_EQ(compass_of({}, robot).noise_rad, radians(2.0));
  EXPECT_EQ(compass_of({}, robot).local_bias_rad, radians(3.0));
  robot.compass_error = {radians(5.0), radians(20.0), 2.0};
  EXPECT_EQ(compass_of({}, robot).noise_rad, radians(5.0));
  EXPECT_GT(compass_of({}, robot).local_bias_rad, radians(10.0));
}

TEST(CompassHeadings, NothingIsAddedForReadingsThatSayNothing) {
  TiedGraph graph;
  CompassHeadings headings(kCompass);
  CompassHeadings none({});
  for (int i = 0; i < 10; ++i) {
    graph.add_node({0.5 * i, 0.0, 0.0});
    headings.add(std::nullopt, 0.5, graph);
    headings.add(std::numeric_limits<double>::quiet_NaN(), 0.5, graph);
    none.add(1.0, 0.5, graph);
  }
  EXPECT_FALSE(graph.has_headings());
  headings.add(1.0, 0.5, graph);
  EXPECT_TRUE(graph.has_headings());
}

// Odometry turns by a degree a metre too much, and the compass is off by 15 all the time.
TEST(CompassHeadings, AConstantBiasTurnsNoMap) {
  const std::vector<DrivenScan> drive = ring_drive(2, radians(1.0), 0.0);
  const auto bias_rad = [](double) { return radians(15.0); };
  EXPECT_GT(worst_turn_rad(driven(drive, {}, bias_rad), drive), radians(60.0)) << "odometry alone";
  EXPECT_LT(worst_turn_rad(driven(drive, kCompass, bias_rad), drive), radians(12.0));
}

TEST(CompassHeadings, SteelBesideTheWayTurnsNoMap) {
  const std::vector<DrivenScan> drive = ring_drive(2, radians(0.3), 0.0);
  const auto steel = [](double way_m) { return std::fmod(way_m, 20.0) < 1.5 ? radians(70.0) : 0.0; };
  const double with_steel_rad = worst_turn_rad(driven(drive, kCompass, steel), drive);
  EXPECT_LT(with_steel_rad, radians(10.0));
  EXPECT_LT(with_steel_rad, 0.5 * worst_turn_rad(driven(drive, {}, steel), drive));
}

TEST(TiedGraph, WhatTheWheelsCountTooMuchOfTurnsIsFoundByLoops) {
  TiedGraph graph;
  graph.expect_odometry(0.0, 0.05);
  Pose2 T_map_counted;
  Pose2 truth;
  graph.add_node({});
  const Eigen::Matrix3d information = Eigen::Vector3d(2500.0, 2500.0, 1e4).asDiagonal();
  for (std::size_t i = 1; i < 120; ++i) {
    const Pose2 step{0.5, 0.0, i % 10 == 0 ? radians(90.0) : 0.0};
    const Pose2 counted{0.5, 0.0, 1.04 * step.theta_rad};
    truth = truth * step;
    T_map_counted = T_map_counted * counted;
    graph.add_node(T_map_counted);
    graph.tie(i - 1, i, counted, information, true);
    if (i >= 40 && i % 5 == 0) graph.add({i - 40, i, {}, 4.0 * information, 1.0});
  }
  EXPECT_TRUE(graph.solve());
  EXPECT_NEAR(graph.errors().turn_ratio, 0.04, 0.01);
  EXPECT_LT((graph.T_map(119).position() - truth.position()).norm(), 0.2);
}

}  // namespace
}  // namespace cairn::submap_graph
