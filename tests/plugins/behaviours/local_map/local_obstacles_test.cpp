#include "plugins/behaviours/local_map/local_obstacles.hpp"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace cairn::behaviours
