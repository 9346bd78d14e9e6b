#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/contracts/ground_truth.hpp"
#include "tests/plugins/python_module/python_file.hpp"

namespace cairn::testing_python {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string giving(const std::string& observation, const std::string& more = "") {
  return "import math\nimport numpy as np\n"
         "class It:\n"
         "  def __init__(self, context): self.context = context\n"
         "  def next(self): return " +
         observation + "\n" + more;
}

std::string error_of_next(const std::string& observation) {
  const auto sensor = sensor_of(giving(observation));
  return error_of([&] { (void)sensor->next({}); });
}

TEST(PythonSensor, GivesAnObservationOfTheRobotsTransducers) {
  const auto sensor = sensor_of(
      giving("{'stamp_s': 1.5, 'odometry': (1, 2, 3), 'ranges_m': [2.0, math.nan, math.inf], 'compass_rad': 0.5, "
             "'bumped': True, 'battery_ratio': np.float64(0.25)}"));
  const SensorStep step = sensor->next({});
  ASSERT_EQ(step.state, SensorState::observation);
  const Observation& seen = step.observation;
  EXPECT_EQ(seen.stamp_s, 1.5);
  EXPECT_EQ(seen.T_odom_robot, (Pose2{1.0, 2.0, 3.0}));
  EXPECT_EQ(seen.compass_rad, 0.5);
  EXPECT_TRUE(seen.bumped);
  EXPECT_EQ(seen.battery_ratio, 0.25);
  ASSERT_EQ(seen.ranges.size(), 2U) << "NaN: it has not fired";
  EXPECT_EQ(seen.ranges[0].range_m, 2.0);
  EXPECT_EQ(seen.ranges[0].T_robot_sensor.theta_rad, radians(90.0));
  EXPECT_EQ(seen.ranges[0].max_m, 5.0);
  EXPECT_EQ(seen.ranges[1].range_m, kInfinity);
  EXPECT_EQ(seen.ranges[1].sensor, 2);
}

TEST(PythonSensor, RangesBeyondTheLimitsOfATransducerAreNoEchoOrTooNear) {
  const auto sensor =
      sensor_of(giving("{'stamp_s': 0, 'odometry': (0, 0), 'sensors': [2, 0], 'ranges_m': np.array([9, 0.01])}"));
  const Observation seen = sensor->next({}).observation;
  ASSERT_EQ(seen.ranges.size(), 2U);
  EXPECT_EQ(seen.ranges[0].sensor, 2);
  EXPECT_EQ(seen.ranges[0].range_m, kInfinity);
  EXPECT_EQ(seen.ranges[1].range_m, -kInfinity);
}

TEST(PythonSensor, NoneIsTheEndAndStaysTheEnd) {
  const auto sensor = sensor_of(giving("None"));
  for (int i = 0; i < 2; ++i) {
    const SensorStep step = sensor->next({});
    EXPECT_EQ(step.state, SensorState::end_of_data);
    EXPECT_THAT(step.reason, HasSubstr("next() has no more observations"));
  }
}

TEST(PythonSensor, KnowsItsStartAndTheTruthWhereItSaysSo) {
  const auto plain = sensor_of(giving("None"));
  EXPECT_EQ(plain->start(), std::nullopt);
  EXPECT_EQ(plain->truth(), nullptr);
  const auto sensor = sensor_of(giving("{'stamp_s': 0, 'odometry': (0, 0), 'true_pose': (4, 5, 0.5)}",
                                       "  def start(self): return 1, 2, 3\n  knows_truth = True\n"));
  EXPECT_EQ(sensor->start(), (Pose2{1.0, 2.0, 3.0}));
  ASSERT_NE(sensor->truth(), nullptr);
  EXPECT_FALSE(sensor->truth()->last_truth());
  (void)sensor->next({});
  EXPECT_EQ(sensor->truth()->last_truth()->T_map_robot, (Pose2{4.0, 5.0, 0.5}));
}

TEST(PythonSensor, WhatItReturnsIsCheckedAndFaultsAreNamed) {
  EXPECT_THAT(error_of_next("3"), HasSubstr("next() returned must be a dict, found int 3"));
  EXPECT_THAT(error_of_next("{'stamp_s': 0}"), HasSubstr("lacks the key \"odometry\""));
  EXPECT_THAT(error_of_next("{'stamp': 0}"), HasSubstr("unknown key \"stamp\""));
  EXPECT_THAT(error_of_next("{'stamp_s': math.inf, 'odometry': (0, 0)}"), HasSubstr("must be finite"));
  const std::string plain = "{'stamp_s': 0, 'odometry': (0, 0), ";
  EXPECT_THAT(error_of_next(plain + "'ranges_m': [1, 2]}"), HasSubstr("has 2 numbers, the robot has 3"));
  EXPECT_THAT(error_of_next(plain + "'ranges_m': [1], 'sensors': [3]}"),
              HasSubstr("there is no transducer 3; the robot has 3, from 0"));
  EXPECT_THAT(error_of_next(plain + "'ranges_m': [[1]], 'sensors': [0]}"),
              HasSubstr("must have one dimension, found 2"));
  EXPECT_THAT(error_of_next(plain + "'ranges_m': 'abc', 'sensors': [0]}"),
              HasSubstr("must be numbers, found str 'abc'"));
  EXPECT_THAT(error_of_next(plain + "'sensors': [0]}"), HasSubstr("has no ranges_m beside it"));
}

}  // namespace
}  // namespace cairn::testing_python
