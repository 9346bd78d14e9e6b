#include "framework/safety/ray_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "framework/safety/range_buffer.hpp"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RobotModel laser_robot(int beams, double field_deg = 180.0) {
  RobotModel robot;
  robot.lasers.emplace_back();
  robot.lasers[0].beams = beams;
  robot.lasers[0].first_angle_rad = radians(-0.5 * field_deg);
  robot.lasers[0].last_angle_rad = radians(0.5 * field_deg);
  robot.lasers[0].rate_hz = 20.0;
  return robot;
}

// What a laser reads where range_m says how far a direction of the odometry's frame is open from a place.
using RangeAt = std::function<double(const Point& from, double bearing_rad)>;

Observation scan(const RobotModel& robot, double stamp_s, const RangeAt& range_m, const Pose2& T_odom_robot = {}) {
  Observation seen;
  seen.stamp_s = stamp_s;
  seen.T_odom_robot = T_odom_robot;
  const LaserModel& laser = robot.lasers[0];
  for (int i = 0; i < laser.beams; ++i) {
    const Pose2 T_robot_beam = laser.T_robot_beam(i);
    const Pose2 T_odom_beam = T_odom_robot * T_robot_beam;
    seen.ranges.push_back(
        {T_robot_beam, 0.0, laser.min_m, laser.max_m, range_m(T_odom_beam.position(), T_odom_beam.theta_rad), i});
  }
  return seen;
}

double everywhere(double range_m, const Point&, double) {
  return range_m;
}

RangeAt wall_across(double x_m) {
  return [x_m](const Point& from, double bearing_rad) {
    const double ahead = std::cos(bearing_rad);
    return ahead > 0.05 ? (x_m - from.x()) / ahead : kInfinity;
  };
}

double fastest_mps(const RangeBuffer& buffer) {
  double fastest = 0.0;
  for (const SeenPoint& seen : buffer.points()) fastest = std::max(fastest, seen.closing_mps);
  return fastest;
}

TEST(RayBuffer, KeepsTheEchoesOfAScanAsPointsForAWhile) {
  const RobotModel robot = laser_robot(181);
  RangeBuffer buffer(robot, 1.0);
  buffer.see(scan(robot, 1.0, [](auto&&... at) { return everywhere(0.8, at...); }));
  EXPECT_EQ(buffer.points().size(), 181U);
  for (const SeenPoint& seen : buffer.points()) {
    EXPECT_NEAR(seen.at.norm(), 0.8, 1e-9);
    EXPECT_NEAR(seen.until_fired_s, 0.05, 1e-9) << "when it scans again";
  }
  buffer.see(scan(robot, 1.9, [](auto&&... at) { return everywhere(kInfinity, at...); }));
  EXPECT_FALSE(buffer.points().empty()) << "silence takes nothing away";
  buffer.see(scan(robot, 2.1, [](auto&&... at) { return everywhere(kInfinity, at...); }));
  EXPECT_TRUE(buffer.points().empty());
}

TEST(RayBuffer, AnEchoFromBehindAPlaceTakesItAway) {
  const RobotModel robot = laser_robot(181);
  RangeBuffer buffer(robot, 1.0);
  buffer.see(scan(robot, 1.0, [](auto&&... at) { return everywhere(0.8, at...); }));
  buffer.see(scan(robot, 1.05, [](const Point&, double bearing_rad) { return bearing_rad > 0.0 ? 2.0 : kInfinity; }));
  for (const SeenPoint& seen : buffer.points())
    EXPECT_TRUE(seen.at.norm() > 1.0 || std::atan2(seen.at.y(), seen.at.x()) < radians(1.01)) << seen.at.transpose();
}

TEST(RayBuffer, AThinPostBetweenBeamsThatPassItStays) {
  const RobotModel robot = laser_robot(721);
  RangeBuffer buffer(robot, 1.0);
  const auto post = [](const Point&, double bearing_rad) { return std::abs(bearing_rad) < radians(0.3) ? 1.0 : 3.0; };
  for (int i = 0; i < 4; ++i) buffer.see(scan(robot, 1.0 + 0.05 * i, post));
  int on_post = 0;
  for (const SeenPoint& seen : buffer.points()) on_post += seen.at.norm() < 1.1 ? 1 : 0;
  EXPECT_GE(on_post, 3);
}

TEST(RayBuffer, SonarsAndLasersDoNotContradictEachOther) {
  RobotModel robot = laser_robot(181);
  robot.sonars.resize(1);
  robot.firing_period_s = 0.04;
  RangeBuffer buffer(robot, 1.0);
  const auto seen_by = [&](double sonar_m, double laser_m, double stamp_s) {
    Observation both = scan(robot, stamp_s, [&](auto&&... at) { return everywhere(laser_m, at...); });
    for (RangeReading& ray : both.ranges) ++ray.sensor;
    both.ranges.insert(both.ranges.begin(), {{}, radians(15.0), 0.1, 5.0, sonar_m, 0});
    buffer.see(both);
    double nearest_m = kInfinity;
    for (const SeenPoint& seen : buffer.points())
      if (std::abs(seen.at.y()) < 0.05) nearest_m = std::min(nearest_m, seen.at.norm());
    return nearest_m;
  };
  EXPECT_NEAR(seen_by(0.7, 3.0, 1.0), 0.7, 1e-6);
  EXPECT_NEAR(seen_by(kInfinity, 3.0, 1.05), 0.7, 1e-6) << "light goes through glass";
  EXPECT_NEAR(seen_by(2.0, 0.5, 3.0), 0.5, 1e-6);
  EXPECT_NEAR(seen_by(2.0, kInfinity, 3.05), 0.5, 1e-6) << "sound glances off a wall";
}

TEST(RayBuffer, WhatStandsStillDoesNotComeNearerHoweverTheRobotMoves) {
  const RobotModel robot = laser_robot(361, 270.0);
  RangeBuffer buffer(robot, 1.0);
  Pose2 pose;
  for (int i = 0; i < 60; ++i) {
    buffer.see(scan(robot, 0.05 * i, wall_across(2.0), pose));
    EXPECT_EQ(fastest_mps(buffer), 0.0) << "scan " << i;
    pose = pose * Pose2{0.015, 0.0, radians(i < 30 ? 4.0 : -4.0)};
  }
}

TEST(RayBuffer, WhatComesTowardsTheRobotDoes) {
  const RobotModel robot = laser_robot(361, 270.0);
  RangeBuffer buffer(robot, 1.0);
  for (int i = 0; i < 10; ++i) {
    const double person_m = 2.0 - 0.05 * i;  // 1 m/s
    buffer.see(scan(robot, 0.05 * i, [&](const Point&, double bearing_rad) {
      return std::abs(bearing_rad) < radians(8.0) ? person_m : 3.0;
    }));
    EXPECT_NEAR(fastest_mps(buffer), i < 4 ? 0.0 : 1.0, 0.05) << "scan " << i;
  }
}

TEST(RayBuffer, HoldsWithTheRoomAndNotWithTheScansSoFar) {
  const RobotModel robot = laser_robot(1081, 270.0);
  RangeBuffer buffer(robot, 5.0, 4.0);
  std::size_t after_a_second = 0;
  for (int i = 0; i < 100; ++i) {
    buffer.see(scan(robot, 0.05 * i, [](auto&&... at) { return everywhere(1.5, at...); }, {0.0, 0.0, 0.01 * i}));
    if (i == 20) after_a_second = buffer.points().size();
  }
  EXPECT_LE(buffer.points().size(), after_a_second + 50U);
}

TEST(RayBuffer, CoversWhereItsBeamsLook) {
  const RobotModel robot = laser_robot(181);
  RangeBuffer buffer(robot, 1.0);
  EXPECT_FALSE(buffer.covers(0.0));
  buffer.see(scan(robot, 1.0, [](auto&&... at) { return everywhere(kInfinity, at...); }));
  EXPECT_TRUE(buffer.covers(0.0)) << "no echo is an answer";
  EXPECT_TRUE(buffer.covers(radians(-90.0)));
  EXPECT_FALSE(buffer.covers(radians(180.0)));
}

TEST(RayBuffer, EchoesFromFarAwayAreLeftOut) {
  const RobotModel robot = laser_robot(181);
  RangeBuffer buffer(robot, 1.0, 2.0);
  buffer.see(scan(robot, 1.0, [](const Point&, double bearing_rad) { return bearing_rad > 0.0 ? 1.9 : 2.1; }));
  for (const SeenPoint& seen : buffer.points()) EXPECT_LT(seen.at.norm(), 2.0);
  EXPECT_FALSE(buffer.points().empty());
}

}  // namespace
}  // namespace cairn
