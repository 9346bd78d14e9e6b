#include "maps/exchange/recordings/ros2_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "maps/exchange/recordings/ros2_read.hpp"
#include "tests/maps/exchange/recordings/small_mcap.hpp"

namespace cairn::exchange::ros2 {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Put together from the rules of CDR: stamp 1 s 2 ns, frame "s", ultrasound, 0.5 rad, 0.25 to 4 m, 1.5 m.
const char* const kRange =
    "00 01 00 00 "
    "01 00 00 00 02 00 00 00 02 00 00 00 73 00 "
    "00 00 "  // the kind, then one to fill up
    "00 00 00 3f 00 00 80 3e 00 00 80 40 00 00 c0 3f ";
const char* const kRangeBigEndian =
    "00 00 00 00 "
    "00 00 00 01 00 00 00 02 00 00 00 02 73 00 "
    "00 00 "
    "3f 00 00 00 3e 80 00 00 40 80 00 00 3f c0 00 00 ";

TEST(Ros2MessagesTest, ARangeIsReadFromItsBytesInBothOrders) {
  for (const char* const hex : {kRange, kRangeBigEndian}) {
    const RangeMessage message = read_range(small_mcap::bytes_of(hex));
    EXPECT_EQ(message.header.stamp_ns, 1'000'000'002);
    EXPECT_EQ(message.header.frame, "s");
    EXPECT_EQ(message.field_of_view_rad, 0.5);
    EXPECT_EQ(message.min_m, 0.25);
    EXPECT_EQ(message.max_m, 4.0);
    EXPECT_EQ(message.range_m, 1.5);
  }
}

TEST(Ros2MessagesTest, ARangeIsWrittenAsItsBytes) {
  EXPECT_EQ(range({1'000'000'002, "s"}, {0.25, 0.25, 4.0, 1.5}), small_mcap::bytes_of(kRange));
}

TEST(Ros2MessagesTest, WhatIsWrittenReadsTheSame) {
  const Header header{5'000'000'007, "frame"};
  const OdometryMessage odom = read_odometry(odometry(header, "base", {1.0, -2.0, 3.0}));
  EXPECT_EQ(odom.header.stamp_ns, 5'000'000'007);
  EXPECT_EQ(odom.header.frame, "frame");
  EXPECT_EQ(odom.child_frame, "base");
  EXPECT_EQ(odom.pose.x_m, 1.0);
  EXPECT_EQ(odom.pose.y_m, -2.0);
  EXPECT_NEAR(heading_rad(odom.pose).value(), 3.0, 1e-15);
  foxglove::Scan scan;
  scan.first_rad = -1.0;
  scan.last_rad = 1.0;
  scan.ranges_m = {0.5, kInfinity, std::nan("")};
  const LaserScanMessage read = read_laser_scan(laser_scan(header, scan, 0.25, 8.0));
  EXPECT_EQ(read.first_rad, -1.0);
  EXPECT_EQ(read.step_rad, 1.0);
  EXPECT_EQ(read.min_m, 0.25);
  EXPECT_EQ(read.max_m, 8.0);
  ASSERT_EQ(read.ranges_m.size(), 3U);
  EXPECT_EQ(read.ranges_m[0], 0.5F);
  EXPECT_TRUE(std::isinf(read.ranges_m[1]));
  EXPECT_TRUE(std::isnan(read.ranges_m[2]));
  EXPECT_NEAR(read_imu(imu(header, -2.5)).heading_rad.value(), -2.5, 1e-15);
  const Transform transforms[] = {{"a", {1.0, 2.0, 0.5}}, {"longer", {0.0, 0.0, -0.5}}};
  const auto tfs = read_tf(tf(header, transforms));
  ASSERT_EQ(tfs.size(), 2U);
  EXPECT_EQ(tfs[1].child_frame, "longer");
  EXPECT_NEAR(heading_rad(tfs[1].pose).value(), -0.5, 1e-15);
  EXPECT_EQ(tfs[0].pose.y_m, 2.0);
}

TEST(Ros2MessagesTest, AMessageThatEndsEarlyOrIsNoCdrIsRefused) {
  const std::string whole = laser_scan({1, "laser"}, {{}, 0.0, 1.0, {1.0, 2.0}}, 0.1, 8.0);
  for (std::size_t size = 0; size + sizeof(std::uint32_t) < whole.size(); ++size)
    EXPECT_THROW((void)read_laser_scan(whole.substr(0, size)), MessageError) << size;
  EXPECT_THROW((void)read_range("\x28\xb5\x2f\xfd compressed"), MessageError);
  EXPECT_THROW((void)read_tf(small_mcap::bytes_of("00 01 00 00 ff ff ff ff")), MessageError);
}

TEST(Ros2MessagesTest, AnOrientationThatIsNoneHasNoHeading) {
  ReadPose pose;
  pose.qw = 0.0;
  EXPECT_FALSE(heading_rad(pose));
  pose.qw = std::nan("");
  EXPECT_FALSE(heading_rad(pose));
  pose = {.qx = 0.0, .qy = 0.0, .qz = 0.6, .qw = 0.8};
  EXPECT_NEAR(heading_rad(pose).value(), 2.0 * std::asin(0.6), 1e-15);
  pose.qx = 0.1;  // tilted, and a little longer than 1
  EXPECT_NEAR(heading_rad(pose).value(), 2.0 * std::asin(0.6), 0.02);
  std::string unknown = imu({1, ""}, 1.0);
  unknown.replace(small_mcap::bytes_of("00").size() * 4 + 8 + 4 + 1 + 3 + 32, 8,
                  std::string("\0\0\0\0\0\0\xf0\xbf", 8));  // the first covariance: -1
  EXPECT_FALSE(read_imu(unknown).heading_rad);
}

}  // namespace
}  // namespace cairn::exchange::ros2
