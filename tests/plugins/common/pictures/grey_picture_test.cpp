#include "plugins/common/pictures/grey_picture.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/common/pictures/written_pictures.hpp"

namespace cairn::pictures {
namespace {

using testing::HasSubstr;
using written_pictures::jpeg;
using written_pictures::png;
using written_pictures::ramp;
using Bytes = std::vector<std::uint8_t>;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

template <class Read>
std::string refusal(Read read) {
  try {
    (void)read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(GreyPicture, APngIsReadAsItIsAndAJpegNearlySo) {
  const CameraImage from_png = unpacked(bytes_of(png(20, 10, ramp(20, 10))));
  EXPECT_EQ(from_png.width_px, 20);
  EXPECT_EQ(from_png.height_px, 10);
  EXPECT_EQ(*from_png.grey, ramp(20, 10));
  const CameraImage from_jpeg = unpacked(bytes_of(jpeg(20, 10, ramp(20, 10))));
  EXPECT_EQ(from_jpeg.width_px, 20);
  EXPECT_EQ(from_jpeg.height_px, 10);
  ASSERT_EQ(from_jpeg.grey->size(), 200U);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR((*from_jpeg.grey)[i], ramp(20, 10)[i], 6) << i;
}

TEST(GreyPicture, WhatIsCutOffOrNoneIsRefused) {
  const std::string whole_png = png(64, 64, ramp(64, 64));
  const std::string whole_jpeg = jpeg(64, 64, ramp(64, 64));
  for (std::size_t size = 8; size + 16 < whole_png.size(); size += 7)
    EXPECT_THAT(refusal([&] { return unpacked(bytes_of(whole_png.substr(0, size))); }), HasSubstr("the PNG")) << size;
  for (std::size_t size = 4; size + 2 < whole_jpeg.size(); size += 7)
    EXPECT_THAT(refusal([&] { return unpacked(bytes_of(whole_jpeg.substr(0, size))); }), HasSubstr("the JPEG")) << size;
  EXPECT_THAT(refusal([] { return unpacked(bytes_of("GIF89a")); }), HasSubstr("neither a PNG nor a JPEG"));
  EXPECT_THAT(refusal([] { return unpacked({}); }), HasSubstr("neither"));
}

// A picture of 4 x 2 pixels of one colour, with 3 bytes more in each row.
int grey_in(const std::string& encoding, const Bytes& even_row, const Bytes& odd_row, bool is_bigendian = false) {
  Bytes data;
  for (const Bytes* const pixels : {&even_row, &odd_row}) {
    for (int i = 0; i < 2; ++i) data.insert(data.end(), pixels->begin(), pixels->end());
    data.insert(data.end(), 3, 99);
  }
  const auto step = static_cast<std::uint32_t>(data.size() / 2);
  const CameraImage image = grey_of({4, 2, encoding, step, is_bigendian, data});
  EXPECT_EQ(image.grey->size(), 8U);
  return image.grey->at(5);
}

TEST(GreyPicture, EncodingsOfMessagesAreWeighedByTheirColours) {
  const Bytes two{10, 10};  // pixels
  EXPECT_EQ(grey_in("mono8", two, two), 10);
  EXPECT_EQ(grey_in("mono16", {7, 20, 7, 20}, {7, 20, 7, 20}), 20);
  EXPECT_EQ(grey_in("mono16", {20, 7, 20, 7}, {20, 7, 20, 7}, true), 20);
  const Bytes red{200, 0, 0, 200, 0, 0};
  EXPECT_EQ(grey_in("rgb8", red, red), 60);
  EXPECT_EQ(grey_in("bgr8", red, red), 23);
  const Bytes red_alpha{200, 0, 0, 255, 200, 0, 0, 255};
  EXPECT_EQ(grey_in("rgba8", red_alpha, red_alpha), 60);
  EXPECT_EQ(grey_in("bgra8", red_alpha, red_alpha), 23);
  const Bytes uyvy{1, 30, 2, 30};
  EXPECT_EQ(grey_in("yuv422", uyvy, uyvy), 30);
  const Bytes yuyv{30, 1, 30, 2};
  EXPECT_EQ(grey_in("yuv422_yuy2", yuyv, yuyv), 30);
}

// Of red light only the red pixels of the pattern know.
TEST(GreyPicture, BayerPatternsAreTakenByTheirFirstPixels) {
  const auto grey_at = [](const std::string& encoding, std::size_t row, std::size_t column) {
    Bytes data(8 * 8, 0);
    for (std::size_t y = row; y < 8; y += 2)
      for (std::size_t x = column; x < 8; x += 2) data[8 * y + x] = 200;
    return int{grey_of({8, 8, encoding, 8, false, data}).grey->at(8 * 4 + 4)};
  };
  EXPECT_NEAR(grey_at("bayer_rggb8", 0, 0), 60, 2);
  EXPECT_NEAR(grey_at("bayer_grbg8", 0, 1), 60, 2);
  EXPECT_NEAR(grey_at("bayer_gbrg8", 1, 0), 60, 2);
  EXPECT_NEAR(grey_at("bayer_bggr8", 1, 1), 60, 2);
  EXPECT_NEAR(grey_at("bayer_bggr8", 0, 0), 23, 2) << "blue";
}

TEST(GreyPicture, MessagesThatCannotBeAreRefused) {
  const Bytes data(24, 0);
  EXPECT_THAT(refusal([&] {
                return grey_of({4, 2, "rgb8", 12, false, std::span(data).first(23)});
              }),
              HasSubstr("its 23 bytes in rows of 12 are too few for 4 x 2 pixels in rgb8"));
  EXPECT_THAT(refusal([&] { return grey_of({4, 2, "rgb8", 11, false, data}); }), HasSubstr("too few"));
  EXPECT_THAT(refusal([&] { return grey_of({4, 2, "rgb8", 0, false, data}); }), HasSubstr("too few"));
  EXPECT_THAT(refusal([&] { return grey_of({4, 2, "32FC1", 16, false, data}); }), HasSubstr("the encoding \"32FC1\""));
  EXPECT_THAT(refusal([&] { return grey_of({0, 2, "mono8", 4, false, data}); }), HasSubstr("0 x 2 pixels"));
  EXPECT_THAT(refusal([&] { return grey_of({4000000000, 4000000000, "mono8", 4, false, data}); }), HasSubstr("pixels"));
}

TEST(GreyPicture, ThePictureMustBeOfTheRobotsCamera) {
  const std::vector<CameraModel> cameras(2);
  EXPECT_EQ(&camera_of(1, cameras), &cameras[1]);
  EXPECT_THAT(refusal([&] { return camera_of(2, cameras).width_px; }),
              HasSubstr("camera 2, and the robot's file has 2"));
  EXPECT_EQ(refusal([&] { return check_size(640, 480, cameras[0]), 0; }), "none");
  EXPECT_THAT(refusal([&] { return check_size(20, 10, cameras[0]), 0; }),
              HasSubstr("20 x 10 pixels, and its camera in the robot's file has 640 x 480"));
}

}  // namespace
}  // namespace cairn::pictures
