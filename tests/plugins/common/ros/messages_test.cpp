#include "plugins/common/ros/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::ros {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Messages, HeadingsAreThoseOfTheQuaternion) {
  for (const double heading : {-3.0, -1.0, 0.0, 0.5, 3.1})
    EXPECT_NEAR(*heading_rad({0.0, 0.0, std::sin(heading / 2), std::cos(heading / 2)}), heading, 1e-12);
  EXPECT_NEAR(*heading_rad({0.0, 0.0, 1.0, 1.0 / 1e9}), std::numbers::pi, 1e-6);
  EXPECT_FALSE(heading_rad({0.0, 0.0, 0.0, 0.0})) << "as drivers leave it that have none";
  EXPECT_FALSE(heading_rad({0.0, 0.0, std::nan(""), 1.0}));
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
  range.range_m = 1.5;
  range.min_m = 0.2;
  range.max_m = 3.0;
  const RangeReading reading = reading_of(range, sonar, 4, 1000.0);
  EXPECT_EQ(reading.T_robot_sensor.y_m, 0.2);
  EXPECT_EQ(reading.range_m, 1.5);
  EXPECT_NEAR(reading.max_m, 3.0, 1e-6);
  EXPECT_EQ(reading.sensor, 4);
  range.min_m = range.max_m = 0.0;
  EXPECT_EQ(reading_of(range, sonar, 4, 1000.0).max_m, sonar.max_m);
}

TEST(Messages, AScanHasTheAnglesOfTheMessageFromWhereTheFileSays) {
  const float ranges[] = {1.0F, 2.0F, 9.0F};
  Scan scan{};
  scan.angle_min_rad = -0.5;
  scan.angle_increment_rad = 0.5;
  scan.min_m = 0.1;
  scan.max_m = 8.0;
  scan.ranges_m = ranges;
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
  scan.angle_increment_rad = std::nan("");
  EXPECT_TRUE(readings_of(scan, laser, 16, 1000.0).empty()) << "nobody knows where they look";
}

TEST(Messages, ACompassMaySayThatItIsNone) {
  Imu imu{};
  imu.orientation = {0.0, 0.0, std::sin(0.5), std::cos(0.5)};
  EXPECT_NEAR(*compass_rad(imu, 0.25), 1.25, 1e-9);
  imu.has_orientation = false;
  EXPECT_FALSE(compass_rad(imu, 0.25));
}

TEST(Messages, BatteriesSaySharesOrPerCentOrNothing) {
  EXPECT_DOUBLE_EQ(*battery_ratio(0.5), 0.5);
  EXPECT_DOUBLE_EQ(*battery_ratio(80.0), 0.8);
  EXPECT_FALSE(battery_ratio(std::nan("")));
}

TEST(Messages, APointOfASonarIsItsRange) {
  SonarModel sonar;
  sonar.T_robot_sonar = {0.1, 0.0, 0.0};
  EXPECT_NEAR(reading_of(Point(1.6, 0.0), sonar, 3, 1000.0).range_m, 1.5, 1e-12);
  EXPECT_EQ(reading_of(Point(1.6, 0.0), sonar, 3, 1000.0).sensor, 3);
  EXPECT_TRUE(std::isinf(reading_of(Point(5.0, 0.0), sonar, 3, 4.9).range_m));
  EXPECT_TRUE(std::isnan(reading_of(Point(std::nan(""), 0.0), sonar, 3, 4.9).range_m));
}

TEST(Messages, FieldsPointNorthFromWhereverTheRobotLooks) {
  for (const double heading : {-2.0, 0.0, 1.0, 3.0}) {
    const MagneticField field{2e-5 * std::cos(-heading), 2e-5 * std::sin(-heading)};
    EXPECT_NEAR(*compass_rad(field, 0.0), heading, 1e-9);
    EXPECT_NEAR(wrap_angle(*compass_rad(field, 0.5) - heading), 0.5, 1e-9);
  }
  EXPECT_FALSE(compass_rad(MagneticField{}, 0.0));
  EXPECT_FALSE(compass_rad(MagneticField{std::nan(""), 0.0}, 0.0));
}

}  // namespace
}  // namespace cairn::ros
