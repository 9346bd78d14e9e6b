// What every map of this program does where the robot stands.
#pragma once

#include <gtest/gtest.h>

#include "framework/contracts/mapper.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::sonar_model {

// map: a new one, whose clear_under() takes the robot.
template <class Map>
void expect_free_where_the_robot_stands(Map map) {
  RobotModel robot;
  robot.radius_m = 0.2;
  map.clear_under(robot);
  const CellChanges changes = map.integrate({}, {Pose2{1.0, 2.0, 0.0}, {}});
  EXPECT_EQ(map.grid().state(map.grid().cell_at({1.1, 2.0})), CellState::free);
  EXPECT_EQ(map.grid().state(map.grid().cell_at({1.3, 2.0})), CellState::unknown);
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.spans.front().y, map.grid().cell_at({1.0, 1.78}).y);
  EXPECT_TRUE(map.integrate({}, {Pose2{1.0, 2.0, 0.0}, {}}).empty());
}

}  // namespace cairn::sonar_model
