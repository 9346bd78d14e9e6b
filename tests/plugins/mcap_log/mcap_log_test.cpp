#include "plugins/mcap_log/mcap_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/plugins/mcap_log/bags.hpp"

namespace cairn::mcap_log {
namespace {

using bags::BagWriter;
using bags::laser_bag;
using bags::played;
using bags::Played;
using testing::HasSubstr;

TEST(McapLog, AScanIsTakenWhereTheOdometryWasAtItsTime) {
  const log_files::LogFolder folder;
  Config config;
  config.compass_from_pose = true;
  const Played log = played(folder, laser_bag(), config);
  ASSERT_EQ(log.seen.size(), 21U) << log.reason;
  EXPECT_FALSE(played(folder, laser_bag()).start) << "odometry knows no place";
  EXPECT_NEAR(log.seen[0].stamp_s, 10.05, 1e-9);
  EXPECT_NEAR(log.seen[3].T_odom_robot.x_m - log.seen[0].T_odom_robot.x_m, 0.3, 1e-9);
  EXPECT_NEAR(log.start->x_m, 0.05, 1e-9) << "between two poses";
  EXPECT_NEAR(log.seen[20].T_odom_robot.x_m, 1.95, 1e-9) << "the last pose, behind which none is known";
  ASSERT_EQ(log.seen[0].ranges.size(), 3U);
  const RangeReading& first = log.seen[0].ranges[0];
  EXPECT_EQ(first.range_m, 1.0);
  EXPECT_NEAR(first.T_robot_sensor.x_m, 0.25, 1e-12);
  EXPECT_NEAR(first.T_robot_sensor.theta_rad, -1.0, 1e-7);
  EXPECT_EQ(first.min_m, 0.125);
  EXPECT_EQ(first.max_m, 8.0);
  EXPECT_EQ(first.half_beam_rad, 0.0);
  EXPECT_EQ(log.reason, "end of a.mcap after 21 observations");
}

TEST(McapLog, GzipAndEveryCompressionReadTheSame) {
  const log_files::LogFolder folder;
  const Played plain = played(folder, laser_bag({"", "t", exchange::McapCompression::none}));
  for (const std::string& bytes : {laser_bag(), folder.gzip(laser_bag())}) {
    const Played other = played(folder, bytes);
    ASSERT_EQ(other.seen.size(), plain.seen.size()) << other.reason;
    EXPECT_EQ(other.seen[7].T_odom_robot, plain.seen[7].T_odom_robot);
    EXPECT_EQ(other.seen[7].ranges[2].range_m, plain.seen[7].ranges[2].range_m);
  }
}

TEST(McapLog, RangesOfOneStampAreOneObservation) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "left", {0.1, 0.2, 0.5 * std::numbers::pi});
  bag.tf("/tf_static", 0.0, "base_link", "right", {0.1, -0.2, -0.5 * std::numbers::pi});
  bag.odom(1.0, {5.0, 6.0, 0.0});
  bag.range(1.0, "left", 1.5, "/sonar/left");
  bag.range(1.0, "right", std::numeric_limits<double>::infinity(), "/sonar/right");
  bag.range(1.5, "right", 0.5, "/sonar/right");
  const std::string bytes = bag.closed();
  const Played log = played(folder, bytes);
  ASSERT_EQ(log.seen.size(), 2U) << log.reason;
  ASSERT_EQ(log.seen[0].ranges.size(), 2U);
  EXPECT_EQ(log.seen[0].ranges[0].range_m, 1.5);
  EXPECT_EQ(log.seen[0].ranges[0].half_beam_rad, 0.25);
  EXPECT_NEAR(log.seen[0].ranges[0].T_robot_sensor.y_m, 0.2, 1e-12);
  EXPECT_TRUE(std::isinf(log.seen[0].ranges[1].range_m));
  EXPECT_EQ(log.seen[0].ranges[1].sensor, log.seen[1].ranges[0].sensor);
  EXPECT_NE(log.seen[0].ranges[0].sensor, log.seen[0].ranges[1].sensor);
  Config config;
  config.compass_from_pose = true;
  EXPECT_EQ(played(folder, bytes, config).start, (Pose2{5.0, 6.0, 0.0}));
}

TEST(McapLog, TransformsServeAsOdometryWhereThereIsNone) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_footprint", "base_link", {0.5, 0.0, 0.0});
  bag.tf("/tf_static", 0.0, "base_link", "laser", {0.25, 0.0, 0.0});
  for (int i = 0; i < 4; ++i) {
    bag.tf("/tf", i, "odom", "base_footprint", {1.0 * i, 0.0, 0.0});
    bag.tf("/tf", i, "map", "odom", {100.0 * i, 0.0, 0.0});
    bag.scan(i, {1.0, 2.0, 3.0});
  }
  const std::string bytes = bag.closed();
  Config config;
  config.compass_from_pose = true;
  const Played log = played(folder, bytes, config);
  ASSERT_EQ(log.seen.size(), 4U) << log.reason;
  EXPECT_NEAR(log.seen[3].T_odom_robot.x_m, 3.0, 1e-12);
  EXPECT_NEAR(log.start->x_m, 0.0, 1e-12);
  EXPECT_NEAR(log.seen[0].ranges[0].T_robot_sensor.x_m, 0.75, 1e-12) << "seen from base_footprint";
  config.base_frame = "base_link";
  EXPECT_NEAR(played(folder, bytes, config).start->x_m, 0.5, 1e-12);
  EXPECT_NEAR(played(folder, bytes, config).seen[0].ranges[0].T_robot_sensor.x_m, 0.25, 1e-12);
}

TEST(McapLog, SensorsThatHangOnMovingTransformsStandWhereTheFirstSays) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.odom(0.0, {});
  bag.tf("/tf", 0.0, "base_link", "laser", {0.5, 0.0, 0.0});
  bag.tf("/tf", 1.0, "base_link", "laser", {0.7, 0.0, 0.0});
  bag.scan(1.0, {1.0, 2.0, 3.0});
  EXPECT_NEAR(played(folder, bag.closed()).seen.at(0).ranges[0].T_robot_sensor.x_m, 0.5, 1e-12);
}

TEST(McapLog, SettingsWinOverWhatTheLogSays) {
  const log_files::LogFolder folder;
  Config config;
  config.frames = {{"laser", -0.5, 0.25, 0.0}};
  config.laser.max_m = 2.5;
  const Played log = played(folder, laser_bag(), config);
  EXPECT_NEAR(log.seen.at(0).ranges[0].T_robot_sensor.x_m, -0.5, 1e-12);
  EXPECT_TRUE(std::isinf(log.seen.at(0).ranges[2].range_m));
  config.odometry = "none";
  EXPECT_EQ(played(folder, laser_bag(), config).seen.at(9).T_odom_robot, Pose2{});
}

TEST(McapLog, AnImuServesAsACompassOnlyWhereItIsSaid) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "laser", {});
  bag.odom(0.0, {});
  for (int i = 0; i < 3; ++i) {
    bag.write("/imu", "sensor_msgs/msg/Imu", i, bags::written::imu({bags::ns_of(i), "imu"}, 0.5 * i));
    bag.scan(i + 0.5, {1.0, 2.0, 3.0});
  }
  const std::string bytes = bag.closed();
  EXPECT_FALSE(played(folder, bytes).seen.at(0).compass_rad);
  Config config;
  config.compass = "/imu";
  config.compass_offset_rad = 1.0;
  EXPECT_NEAR(played(folder, bytes, config).seen.at(0).compass_rad.value(), 1.25, 1e-9);
  EXPECT_NEAR(played(folder, bytes, config).seen.at(2).compass_rad.value(), 2.0, 1e-9);
}

TEST(McapLog, MessagesThatComeLateAreSortedByTheirStamps) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "laser", {});
  bag.odom(1.0, {});
  bag.scan(1.3, {1.0, 1.0, 1.0});
  bag.odom(1.2, {0.2, 0.0, 0.0});
  bag.scan(1.1, {2.0, 2.0, 2.0}, "/scan");
  bag.odom(1.4, {0.4, 0.0, 0.0});
  const Played log = played(folder, bag.closed());
  ASSERT_EQ(log.seen.size(), 2U);
  EXPECT_EQ(log.seen[0].ranges[0].range_m, 2.0);
  EXPECT_NEAR(log.seen[1].T_odom_robot.x_m, 0.2, 1e-9);
  EXPECT_EQ(log.reason, "end of a.mcap after 2 observations");
}

TEST(McapLog, AClockThatJumpsBackBeginsAnotherPart) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "laser", {});
  for (const double begin_s : {100.0, 3.0})
    for (int i = 0; i < 3; ++i) {
      bag.odom(begin_s + i, {begin_s + i, 0.0, 0.0});
      bag.scan(begin_s + i, {1.0, 2.0, 3.0});
    }
  const Played log = played(folder, bag.closed());
  ASSERT_EQ(log.seen.size(), 6U);
  EXPECT_NEAR(log.seen[2].T_odom_robot.x_m, 2.0, 1e-9);
  EXPECT_NEAR(log.seen[3].T_odom_robot.x_m, -97.0, 1e-9);
  EXPECT_NEAR(log.seen[3].stamp_s, 102.1, 1e-9);
  EXPECT_THAT(log.reason, HasSubstr("1 clock jump bridged, the first at observation 4"));
}

}  // namespace
}  // namespace cairn::mcap_log
