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

TEST(SonarRing, RefusesAFiringOrderThatNamesNoSonarOfTheRobot) {
  RobotModel robot = robot_with_sonars(2);
  robot.firing_order = {0, 2};
  const Scene scene{World{}};
  EXPECT_THROW(SonarRing({}, robot, scene, 1), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
