#include "plugins/behaviours/local_map/local_obstacles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace cairn::behaviours {
namespace {

const double kNever = std::numeric_limits<double>::infinity();

TEST(LocalObstacles, WhatALiveEchoComesThroughIsNotInTheWay) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds(grid.cell_at({0.6, 0.0}), 600);  // somebody who has gone on
  const LandmarkGraph graph;
  const RobotModel robot;
  const NearEchoes near_echoes(grid);
  const auto obstacles_with = [&](double range_m) {
    Observation observation;
    observation.ranges = {{{0.1, 0.0, 0.0}, radians(15.0), 0.1, 5.0, range_m, 0}};
    LocalObstacles obstacles;
    obstacles.see({grid, graph, robot, {Pose2{}, Eigen::Matrix3d::Zero()}, 1.0, &observation}, near_echoes);
    return obstacles.points().size();
  };
  EXPECT_EQ(obstacles_with(kNever), 1U) << "silence says nothing";
  EXPECT_EQ(obstacles_with(2.0), 0U);
  EXPECT_EQ(obstacles_with(0.5), 1U) << "the echo came from there";
  EXPECT_GT(obstacles_with(0.3), 1U) << "something else: its whole arc besides";
}

// Rays from the robot's origin, all round.
Observation scan(const std::vector<double>& ranges_m) {
  Observation seen;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const double bearing_rad =
        wrap_angle(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(ranges_m.size()));
    seen.ranges.push_back({{0.0, 0.0, bearing_rad}, 0.0, 0.05, 8.0, ranges_m[i], static_cast<int>(i)});
  }
  return seen;
}

TEST(LocalObstacles, AScanSaysOfAPlaceWhatEachOfItsRaysSays) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> ranges_m(720);
  for (double& range_m : ranges_m) range_m = unit(random) < 0.1 ? kNever : 0.1 + 2.0 * unit(random);
  const Observation seen = scan(ranges_m);
  LocalObstacles obstacles;
  obstacles.see({grid, graph, robot, {Pose2{0.3, 0.2, 1.1}, Eigen::Matrix3d::Zero()}, 1.0, &seen}, NearEchoes(grid));
  const LocalObstacleSettings settings;
  for (int i = 0; i < 500; ++i) {
    const Point p(4.0 * unit(random) - 2.0, 4.0 * unit(random) - 2.0);
    auto expected = LocalObstacles::Live::silent;
    for (const RangeReading& ray : seen.ranges) {
      if (std::isinf(ray.range_m)) continue;
      const Point to = inverse(Pose2{0.3, 0.2, 1.1} * ray.T_robot_sensor) * p;
      if (std::abs(std::atan2(to.y(), to.x())) > settings.min_beam_rad) continue;
      const double behind_m = ray.range_m - to.norm();
      if (behind_m >= settings.behind_m) expected = LocalObstacles::Live::seen_through;
      if (behind_m >= -settings.behind_m && behind_m < settings.behind_m && expected == LocalObstacles::Live::silent)
        expected = LocalObstacles::Live::there;
    }
    EXPECT_EQ(obstacles.live_echo_at(p, 1.0), expected) << p.transpose();
  }
}

TEST(LocalObstacles, PointsOfAScanAreAsManyAsThereIsRoomForThem) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  const auto points_of = [&](std::size_t beams) {
    const Observation seen = scan(std::vector<double>(beams, 1.0));
    LocalObstacles obstacles;
    obstacles.see({grid, graph, robot, {Pose2{}, Eigen::Matrix3d::Zero()}, 1.0, &seen}, NearEchoes(grid));
    return obstacles.points().size();
  };
  EXPECT_EQ(points_of(90), 90U);
  EXPECT_LT(points_of(2000), 320U) << "2 cm apart on a circle of 6.3 m";
}

}  // namespace
}  // namespace cairn::behaviours
