// Pictures of cameras in a bag.
#include <gmock/gmock.h>

#include "plugins/mcap_log/mcap_log.hpp"
#include "tests/plugins/common/pictures/written_pictures.hpp"
#include "tests/plugins/mcap_log/bags.hpp"

namespace cairn::mcap_log {
namespace {

using bags::BagWriter;
using bags::Played;
using testing::ElementsAre;
using testing::HasSubstr;
using written_pictures::jpeg;
using written_pictures::ramp;

const std::string kGrey(20 * 10, 'd');

std::vector<CameraModel> cameras() {
  CameraModel camera;
  camera.width_px = 20;
  camera.height_px = 10;
  return {camera, camera};
}

// A robot that stands, with a scan each half second from 10 s on.
BagWriter bag_with_scans() {
  BagWriter bag;
  for (int i = 0; i < 4; ++i) {
    bag.odom(10.0 + 0.5 * i, {});
    bag.tf("/tf_static", 10.0, "base_link", "laser", {});
    bag.scan(10.0 + 0.5 * i, {1.0, 2.0, 3.0});
  }
  return bag;
}

Played played_with_pictures(const log_files::LogFolder& folder, BagWriter& bag, Config config = {}) {
  config.file = folder.write("a.mcap", bag.closed());
  Played played;
  try {
    LogWithPictures log = read_with_pictures(config, cameras());
    pictures::PicturePlayer player(std::make_shared<log_common::ScanPlayer>(std::move(log.scans)), log.pictures);
    played.seen = log_files::play(player, played.reason);
  } catch (const ConfigError& error) {
    played.reason = folder.without_folder(error.what());
  }
  return played;
}

std::vector<double> stamps_of(const Observation& seen) {
  std::vector<double> stamps_s;
  for (const CameraImage& image : seen.images) stamps_s.push_back(image.stamp_s);
  return stamps_s;
}

TEST(McapPictures, GoWithTheScanNextAfterThem) {
  const log_files::LogFolder folder;
  BagWriter bag = bag_with_scans();
  bag.image(11.25, 20, 10, "mono8", kGrey);  // behind all scans in the file
  bag.packed_image(11.0, jpeg(20, 10, ramp(20, 10)));
  bag.image(10.75, 20, 10, "mono8", kGrey);
  bag.image(12.0, 20, 10, "mono8", kGrey);
  Config config;
  config.images = {{"/image", 1}, {"/image/compressed", 0}};
  const Played log = played_with_pictures(folder, bag, config);
  ASSERT_EQ(log.seen.size(), 4U) << log.reason;
  EXPECT_THAT(stamps_of(log.seen[1]), ElementsAre());
  ASSERT_THAT(stamps_of(log.seen[2]), ElementsAre(10.75, 11.0));
  EXPECT_THAT(stamps_of(log.seen[3]), ElementsAre(11.25));
  EXPECT_EQ(log.seen[2].images[0].camera, 1);
  EXPECT_EQ(*log.seen[2].images[0].grey, std::vector<std::uint8_t>(200, 'd'));
  const CameraImage& packed = log.seen[2].images[1];
  EXPECT_EQ(packed.camera, 0);
  ASSERT_EQ(packed.grey->size(), 200U);
  EXPECT_NEAR(packed.grey->at(100), 127, 6);
  EXPECT_EQ(log.reason, "end of a.mcap after 4 observations");
}

TEST(McapPictures, TheOnlyTopicIsThatOfCamera0AndOfSeveralOneIsChosen) {
  const log_files::LogFolder folder;
  BagWriter one = bag_with_scans();
  one.image(10.5, 20, 10, "mono8", kGrey);
  const Played log = played_with_pictures(folder, one);
  ASSERT_EQ(log.seen.size(), 4U) << log.reason;
  ASSERT_EQ(log.seen[1].images.size(), 1U);
  EXPECT_EQ(log.seen[1].images[0].camera, 0);
  BagWriter two = bag_with_scans();
  two.image(10.5, 20, 10, "mono8", kGrey);
  two.image(10.5, 20, 10, "mono8", kGrey, "/left");
  EXPECT_THAT(played_with_pictures(folder, two).reason,
              HasSubstr("several topics of pictures; choose by `images` among /image, /left"));
}

TEST(McapPictures, ThoseThatNobodyWantsAreNotRead) {
  const log_files::LogFolder folder;
  BagWriter bag = bag_with_scans();
  bag.packed_image(10.5, "no picture");
  Config config;
  config.images = {{"/nowhere", 0}};
  const Played log = bags::played(folder, bag.closed(), config);
  ASSERT_EQ(log.seen.size(), 4U) << log.reason;
  EXPECT_TRUE(log.seen[1].images.empty());
}

TEST(McapPictures, WhatCannotBeIsABadRecord) {
  const log_files::LogFolder folder;
  const auto reason_with = [&](auto add, Config config = {}) {
    BagWriter bag = bag_with_scans();
    add(bag);
    return played_with_pictures(folder, bag, config).reason;
  };
  EXPECT_THAT(reason_with([](BagWriter& bag) { bag.packed_image(10.5, "no picture"); }),
              HasSubstr("it is neither a PNG nor a JPEG picture"));
  EXPECT_THAT(reason_with([](BagWriter& bag) { bag.image(10.5, 20, 10, "32FC1", kGrey); }),
              HasSubstr("a picture in the encoding \"32FC1\""));
  EXPECT_THAT(reason_with([](BagWriter& bag) { bag.image(10.5, 10, 20, "mono8", kGrey); }),
              HasSubstr("a picture of 10 x 20 pixels, and its camera in the robot's file has 20 x 10"));
  Config skip;
  skip.on_bad_line = log_common::BadLine::skip;
  EXPECT_THAT(reason_with([](BagWriter& bag) { bag.packed_image(10.5, "no picture"); }, skip),
              HasSubstr("1 bad record skipped"));
  const auto add = [](BagWriter& bag) { bag.image(10.5, 20, 10, "mono8", kGrey); };
  Config other;
  other.images = {{"/imag", 0}};
  EXPECT_THAT(reason_with(add, other), HasSubstr("images: the log has no topic \"/imag\""));
  other.images = {{"/scan", 0}};
  EXPECT_THAT(reason_with(add, other), HasSubstr("not of sensor_msgs/msg/Image or CompressedImage"));
  other.images = {{"/image", 2}};
  EXPECT_THAT(reason_with(add, other), HasSubstr("camera 2, and the robot's file has 2"));
}

}  // namespace
}  // namespace cairn::mcap_log
