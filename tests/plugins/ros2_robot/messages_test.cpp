#include "plugins/ros2_robot/messages.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/common/pictures/written_pictures.hpp"

namespace cairn::ros2_robot {
namespace {

TEST(Messages, StampsAreSecondsAndNanoseconds) {
  EXPECT_DOUBLE_EQ(seconds_of({12, 500000000}), 12.5);
  const Time time = time_of(1764000000.25);
  EXPECT_EQ(time.sec, 1764000000);
  EXPECT_EQ(time.nanosec, 250000000U);
}

TEST(Messages, OfTheWireAreReadFieldByField) {
  char frame[] = "laser";
  char child[] = "base_link";
  Odometry odometry{};
  odometry.header = {{12, 500000000}, frame};
  odometry.child_frame_id = child;
  odometry.pose.pose = {{1.0, 2.0, 0.5}, {0.1, 0.2, 0.3, 0.4}};
  const ros::Odometry read = message_of(odometry);
  EXPECT_EQ(read.header.stamp_s, 12.5);
  EXPECT_EQ(read.header.frame, "laser");
  EXPECT_EQ(read.child_frame, "base_link");
  EXPECT_EQ(read.position_m, Point(1.0, 2.0));
  EXPECT_EQ(read.orientation.z, 0.3);
  EXPECT_EQ(read.orientation.w, 0.4);

  Range range{};
  range.min_range = 0.5F;
  range.max_range = 4.0F;
  range.range = 1.5F;
  EXPECT_EQ(message_of(range).min_m, 0.5);
  EXPECT_EQ(message_of(range).max_m, 4.0);
  EXPECT_EQ(message_of(range).range_m, 1.5);
  EXPECT_EQ(message_of(range).header.frame, "") << "none";

  float ranges[] = {1.0F, 2.0F};
  LaserScan scan{};
  scan.angle_min = -0.5F;
  scan.angle_increment = 0.25F;
  scan.range_max = 8.0F;
  scan.ranges._buffer = ranges;
  scan.ranges._length = 2;
  EXPECT_EQ(message_of(scan).angle_min_rad, -0.5);
  EXPECT_EQ(message_of(scan).angle_increment_rad, 0.25);
  EXPECT_EQ(message_of(scan).max_m, 8.0);
  EXPECT_EQ(message_of(scan).ranges_m.back(), 2.0F);

  Imu imu{};
  imu.orientation.w = 1.0;
  EXPECT_TRUE(message_of(imu).has_orientation);
  EXPECT_EQ(message_of(imu).orientation.w, 1.0);
  imu.orientation_covariance[0] = -1.0;
  EXPECT_FALSE(message_of(imu).has_orientation);

  MagneticField field{};
  field.magnetic_field = {1e-5, 2e-5, 3e-5};
  EXPECT_EQ(message_of(field).x_t, 1e-5);
  EXPECT_EQ(message_of(field).y_t, 2e-5);
}

TEST(Messages, PicturesAreMadeGrey) {
  char encoding[] = "bgr8";
  std::uint8_t pixels[] = {0, 0, 200, 200, 0, 0};
  Image image{};
  image.width = 2;
  image.height = 1;
  image.encoding = encoding;
  image.step = 6;
  image.data._buffer = pixels;
  image.data._length = 6;
  EXPECT_EQ(*picture_of(image).grey, (std::vector<std::uint8_t>{60, 23})) << "a red one and a blue one";
  image.data._length = 5;
  EXPECT_THROW((void)picture_of(image), std::runtime_error);
  EXPECT_THROW((void)picture_of(CompressedImage{}), std::runtime_error);

  std::string jpeg = written_pictures::jpeg(8, 8, std::vector<std::uint8_t>(64, 90));
  CompressedImage packed{};
  packed.data._buffer = reinterpret_cast<std::uint8_t*>(jpeg.data());
  packed.data._length = static_cast<std::uint32_t>(jpeg.size());
  EXPECT_EQ(picture_of(packed).width_px, 8);
  EXPECT_NEAR(picture_of(packed).grey->at(20), 90, 2);
}

}  // namespace
}  // namespace cairn::ros2_robot
