// Pictures that Fast DDS writes, in pieces: one is larger than what a packet of UDP can hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "framework/live/live_robot.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"
#include "tests/fast_dds/messages_by_hand.hpp"
#include "tests/fast_dds/stranger.hpp"
#include "tests/plugins/common/pictures/written_pictures.hpp"

namespace cairn::fast_dds {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 480;

ros2_robot::Config config_with_pictures() {
  ros2_robot::Config made;
  made.domain = own_domain();
  made.network = ros2_robot::Network::localhost;
  made.ranges = {{"/sonar", ros2_robot::RangeKind::range, {}, 0}};
  made.images = {{"/camera/image_raw", ros2_robot::ImageKind::raw, 0},
                 {"/rear/image_raw/compressed", ros2_robot::ImageKind::compressed, 1}};
  return made;
}

RobotModel robot_with_two_cameras() {
  RobotModel model;
  model.sonars.resize(1);
  model.cameras.resize(2);
  for (CameraModel& camera : model.cameras) {
    camera.width_px = kWidth_px;
    camera.height_px = kHeight_px;
  }
  return model;
}

class PicturesOfAStranger : public testing::TestWithParam<bool> {
 protected:
  void publish(std::int32_t tick) {
    const Stamped header{1000 + tick / 50, static_cast<std::uint32_t>(tick % 50) * 20'000'000U, "camera"};
    raw_->write(written([&](Cdr& to) { write_image(to, header, kHeight_px, kWidth_px, "rgb8", 3 * kWidth_px, rgb_); }));
    packed_->write(written([&](Cdr& to) { write_compressed_image(to, header, "jpeg", jpeg_); }));
    odometry_->write(written([&](Cdr& to) {
      write_odometry(to, {header.sec, header.nanosec, "odom"}, "base_link", {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
    }));
    sonar_->write(written([&](Cdr& to) { write_range(to, header, 2.5F); }));
  }

  Stranger stranger_{own_domain()};
  const Offer offer_{GetParam(), false};
  std::unique_ptr<Stranger::Writer> raw_ =
      stranger_.writer("/camera/image_raw", "sensor_msgs::msg::dds_::Image_", offer_);
  std::unique_ptr<Stranger::Writer> packed_ =
      stranger_.writer("/rear/image_raw/compressed", "sensor_msgs::msg::dds_::CompressedImage_", offer_);
  std::unique_ptr<Stranger::Writer> odometry_ = stranger_.writer("/odom", "nav_msgs::msg::dds_::Odometry_");
  std::unique_ptr<Stranger::Writer> sonar_ = stranger_.writer("/sonar", "sensor_msgs::msg::dds_::Range_");
  // Grey ones, so that each channel is what they are in the end.
  const std::vector<std::uint8_t> grey_ = written_pictures::ramp(kWidth_px, kHeight_px);
  std::vector<std::uint8_t> rgb_ = [this] {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * grey_.size());
    for (const std::uint8_t value : grey_) rgb.insert(rgb.end(), 3, value);
    return rgb;
  }();
  std::string jpeg_ = written_pictures::jpeg(kWidth_px, kHeight_px, grey_);
};

TEST_P(PicturesOfAStranger, ComeAsTheyWereWritten) {
  const ros2_robot::Config config = config_with_pictures();
  live::LiveRobot driven(link_to(config, robot_with_two_cameras(), {}, {}, true), config.stop_when,
                         robot_with_two_cameras());
  std::jthread robot([this](const std::stop_token& ended) {
    for (std::int32_t tick = 0; !ended.stop_requested(); ++tick) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      publish(tick);
    }
  });
  std::optional<CameraImage> raw;
  std::optional<CameraImage> packed;
  ASSERT_TRUE(comes_true([&] {
    const SensorStep step = driven.next({});
    EXPECT_EQ(step.state, SensorState::observation) << step.reason;
    for (const CameraImage& image : step.observation.images) (image.camera == 0 ? raw : packed) = image;
    return raw && packed;
  }));
  EXPECT_EQ(raw->width_px, kWidth_px);
  EXPECT_EQ(*raw->grey, grey_);
  ASSERT_EQ(packed->grey->size(), grey_.size());
  EXPECT_NEAR(packed->grey->at(100'000), grey_[100'000], 4);
}

INSTANTIATE_TEST_SUITE_P(ReliableOrNot, PicturesOfAStranger, testing::Bool());

}  // namespace
}  // namespace cairn::fast_dds
