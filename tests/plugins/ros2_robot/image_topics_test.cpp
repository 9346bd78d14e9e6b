// Pictures on the network.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/messages.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"
#include "tests/plugins/common/pictures/written_pictures.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

Config image_config() {
  Config made;
  made.domain = 1 + static_cast<int>(::getpid() % 99);
  made.network = Network::localhost;
  made.ranges = {{"/sonar", RangeKind::range, {}, 0}};
  made.images = {{"/left", ImageKind::raw, 1}, {"/right", ImageKind::compressed, 0}};
  return made;
}

RobotModel robot_with_cameras() {
  RobotModel model;
  model.sonars.resize(1);
  model.cameras.resize(2);
  for (CameraModel& camera : model.cameras) {
    camera.width_px = 16;
    camera.height_px = 8;
  }
  return model;
}

// A robot that says its odometry and two cameras' pictures.
class ImageTopicsTest : public testing::Test {
 protected:
  void say(double stamp_s, double image_s, std::uint32_t height_px = 8) {
    Image raw{};
    raw.header = {time_of(image_s), frame_};
    raw.width = 16;
    raw.height = height_px;
    raw.encoding = encoding_;
    raw.step = 16;
    raw.data._buffer = grey_.data();
    raw.data._length = 16 * height_px;
    (void)dds_write(left_.get(), &raw);
    CompressedImage packed{};
    packed.header = {time_of(image_s), frame_};
    packed.data._buffer = reinterpret_cast<std::uint8_t*>(jpeg_.data());
    packed.data._length = static_cast<std::uint32_t>(jpeg_.size());
    (void)dds_write(right_.get(), &packed);
    Odometry odometry{};
    odometry.header = {time_of(stamp_s), frame_};
    odometry.child_frame_id = frame_;
    odometry.pose.pose.orientation.w = 1.0;
    (void)dds_write(odometry_.get(), &odometry);
  }
  // The cameras seen in half a second or until both are; each picture is 0.05 s older than the odometry beside it, or
  // what else is said.
  std::vector<CameraImage> seen_by(live::BaseLink& link, double age_s = 0.05, std::uint32_t height_px = 8) {
    std::string why;
    for (int i = 0; i < 5 && !link.connect({}, why); ++i) {
    }
    std::vector<CameraImage> images;
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < 0.5;) {
      stamp_s_ += 0.02;
      say(stamp_s_, stamp_s_ - age_s, height_px);
      std::vector<Observation> seen;
      EXPECT_TRUE(link.receive(seen));
      for (const Observation& observation : seen)
        for (const CameraImage& image : observation.images) {
          EXPECT_LE(image.stamp_s, observation.stamp_s);
          EXPECT_GE(image.stamp_s, observation.stamp_s - 0.5);
          EXPECT_NEAR(std::remainder(image.stamp_s + age_s, 0.02), 0.0, 1e-6) << "by the odometry's clock";
          images.push_back(image);
        }
      const auto is_of = [](int camera) {
        return [camera](const CameraImage& image) { return image.camera == camera; };
      };
      if (std::ranges::any_of(images, is_of(0)) && std::ranges::any_of(images, is_of(1))) break;
    }
    return images;
  }
  [[nodiscard]] std::size_t subscribers(const std::string& topic) const {
    return static_cast<std::size_t>(
        std::ranges::count(participant_.subscribers(), topic, [](const Endpoint& endpoint) { return endpoint.topic; }));
  }

  Participant participant_{{image_config().domain, true, "", {}}};
  Entity odometry_ = participant_.writer("/odom", nav_msgs_msg_dds__Odometry__desc);
  Entity left_ = participant_.writer("/left", sensor_msgs_msg_dds__Image__desc);
  Entity right_ = participant_.writer("/right", sensor_msgs_msg_dds__CompressedImage__desc);
  std::vector<std::uint8_t> grey_ = written_pictures::ramp(16, 8);
  std::string jpeg_ = written_pictures::jpeg(16, 8, grey_);
  char frame_[10] = "base_link";
  char encoding_[6] = "mono8";
  double stamp_s_ = 1000.0;
};

TEST_F(ImageTopicsTest, BothKindsOfPicturesComeWithTheOdometry) {
  const auto link = link_to(image_config(), robot_with_cameras(), {}, {}, true);
  const std::vector<CameraImage> images = seen_by(*link);
  const auto raw = std::ranges::find(images, 1, &CameraImage::camera);
  const auto packed = std::ranges::find(images, 0, &CameraImage::camera);
  ASSERT_NE(raw, images.end());
  ASSERT_NE(packed, images.end());
  EXPECT_EQ(raw->width_px, 16);
  EXPECT_EQ(*raw->grey, grey_);
  ASSERT_EQ(packed->grey->size(), grey_.size());
  EXPECT_NEAR(packed->grey->at(64), grey_[64], 8);
}

TEST_F(ImageTopicsTest, NothingIsSubscribedToWhenNobodyWantsPictures) {
  const auto link = link_to(image_config(), robot_with_cameras());
  EXPECT_TRUE(seen_by(*link).empty());
  EXPECT_EQ(subscribers("/odom"), 1U);
  EXPECT_EQ(subscribers("/left"), 0U);
}

TEST_F(ImageTopicsTest, PicturesOfAnotherTimeAreLeftOut) {
  const auto link = link_to(image_config(), robot_with_cameras(), {}, {}, true);
  EXPECT_TRUE(seen_by(*link, 1.5).empty());
  EXPECT_TRUE(seen_by(*link, -1.0).empty());
}

TEST_F(ImageTopicsTest, PicturesThatAreAheadOfTheOdometryWaitForIt) {
  const auto link = link_to(image_config(), robot_with_cameras(), {}, {}, true);
  EXPECT_GE(seen_by(*link, -0.05).size(), 2U) << "none is younger than the observation that it comes with";
}

TEST_F(ImageTopicsTest, ADamagedPictureIsLeftOutAndManyInSequenceAreAFault) {
  const auto link = link_to(image_config(), robot_with_cameras(), {}, {}, true);
  const std::string whole = jpeg_;
  ASSERT_FALSE(seen_by(*link).empty());
  jpeg_.resize(jpeg_.size() / 2);
  std::vector<Observation> seen;
  for (int i = 0; i < 3; ++i) {
    stamp_s_ += 0.02;
    say(stamp_s_, stamp_s_);
    EXPECT_TRUE(link->receive(seen));
  }
  jpeg_ = whole;
  EXPECT_GE(seen_by(*link).size(), 2U);
  jpeg_.resize(jpeg_.size() / 2);
  try {
    for (int i = 0; i < 50; ++i) {
      stamp_s_ += 0.02;
      say(stamp_s_, stamp_s_);
      (void)link->receive(seen);
    }
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/right: the JPEG cannot be read"));
  }
}

TEST_F(ImageTopicsTest, PicturesThatAreNotTheRobotFilesAreAFault) {
  const auto link = link_to(image_config(), robot_with_cameras(), {}, {}, true);
  try {
    (void)seen_by(*link, 0.05, 4);
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/left: a picture of 16 x 4 pixels, and its camera in the robot's file has"));
  }
  Config third = image_config();
  third.images[0].camera = 2;
  EXPECT_THROW((void)link_to(third, robot_with_cameras(), {}, {}, true), std::invalid_argument);
}

}  // namespace
}  // namespace cairn::ros2_robot
