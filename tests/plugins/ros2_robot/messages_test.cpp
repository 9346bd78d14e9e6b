#include "plugins/ros2_robot/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn::ros2_robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Messages, HeadingsAreThoseOfTheQuaternion) {
  for (const double heading : {-3.0, -1.0, 0.0, 0.5, 3.1})
    EXPECT_NEAR(*heading_rad({0.0, 0.0, std::sin(heading / 2), std::cos(heading / 2)}), heading, 1e-12);
  EXPECT_NEAR(*heading_rad({0.0, 0.0, 1.0, 1.0 / 1e9}), std::numbers::pi, 1e-6);
  EXPECT_FALSE(heading_rad({0.0, 0.0, 0.0, 0.0})) << "as drivers leave it that have none";
  EXPECT_FALSE(heading_rad({0.0, 0.0, std::nan(""), 1.0}));
}

TEST(Messages, StampsAreSecondsAndNanoseconds) {
  EXPECT_DOUBLE_EQ(seconds_of({12, 500000000}), 12.5);
  const Time time = time_of(1764000000.25);
  EXPECT_EQ(time.sec, 1764000000);
  EXPECT_EQ(time.nanosec, 250000000U);
}

TEST(Messages, RangesFollowRep117) {
  EXPECT_EQ(range_m(2.0, 0.1, 5.0, 4.9), 2.0);
  EXPECT_EQ(range_m(4.95, 0.1, 5.0, 4.9), kInfinity) << "as drivers say that hear nothing";
  EXPECT_EQ(range_m(kInfinity, 0.1, 5.0, 1000.0), kInfinity);
  EXPECT_EQ(range_m(5.0, 0.1, 5.0, 1000.0), kInfinity);
  EXPECT_EQ(range_m(0.05, 0.1, 5.0, 1000.0), -kInfinity);
  EXPECT_EQ(range_m(-kInfinity, 0.1, 5.0, 1000.0), -kInfinity);
  EXPECT_TRUE(std::isnan(range_m(std::nan(""), 0.1, 5.0, 1000.0)));
}

TEST(Messages, ASonarStandsWhereTheFileSaysWithTheLimitsOfTheMessage) {
  SonarModel sonar;
  sonar.T_robot_sonar = {0.1, 0.2, 0.3};
  Range range{};
  range.range = 1.5F;
  range.min_range = 0.2F;
  range.max_range = 3.0F;
  const RangeReading reading = reading_of(range, sonar, 4, 1000.0);
  EXPECT_EQ(reading.T_robot_sensor.y_m, 0.2);
  EXPECT_EQ(reading.range_m, 1.5);
  EXPECT_NEAR(reading.max_m, 3.0, 1e-6);
  EXPECT_EQ(reading.sensor, 4);
  range.min_range = range.max_range = 0.0F;
  EXPECT_EQ(reading_of(range, sonar, 4, 1000.0).max_m, sonar.max_m);
}

TEST(Messages, AScanHasTheAnglesOfTheMessageFromWhereTheFileSays) {
  float ranges[] = {1.0F, 2.0F, 9.0F};
  LaserScan scan{};
  scan.angle_min = -0.5F;
  scan.angle_increment = 0.5F;
  scan.range_min = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges._buffer = ranges;
  scan.ranges._length = 3;
  LaserModel laser;
  laser.T_robot_laser = {0.2, 0.0, std::numbers::pi};  // looks back
  const std::vector<RangeReading> readings = readings_of(scan, laser, 16, 1000.0);
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_NEAR(readings[0].T_robot_sensor.theta_rad, std::numbers::pi - 0.5, 1e-6);
  EXPECT_EQ(readings[0].T_robot_sensor.x_m, 0.2);
  EXPECT_EQ(readings[1].range_m, 2.0);
  EXPECT_EQ(readings[2].range_m, kInfinity);
  EXPECT_EQ(readings[2].sensor, 18);
  EXPECT_EQ(readings_of(scan, laser, kMaxTransducers - 1, 1000.0).size(), 1U) << "numbers end";
}

TEST(Messages, ACompassMaySayThatItIsNone) {
  Imu imu{};
  imu.orientation = {0.0, 0.0, std::sin(0.5), std::cos(0.5)};
  EXPECT_NEAR(*compass_rad(imu, 0.25), 1.25, 1e-9);
  imu.orientation_covariance[0] = -1.0;
  EXPECT_FALSE(compass_rad(imu, 0.25));
}

TEST(Messages, BatteriesSaySharesOrPerCentOrNothing) {
  BatteryState battery{};
  battery.percentage = 0.5F;
  EXPECT_DOUBLE_EQ(*battery_ratio(battery), 0.5);
  battery.percentage = 80.0F;
  EXPECT_DOUBLE_EQ(*battery_ratio(battery), 0.8);
  battery.percentage = std::nanf("");
  EXPECT_FALSE(battery_ratio(battery));
}

}  // namespace
}  // namespace cairn::ros2_robot
