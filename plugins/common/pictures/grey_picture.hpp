// Pictures as files and messages have them, made grey. Stamp and camera are left to the caller.
//
// All of these throw std::runtime_error with what is wrong with the picture.
#pragma once

#include <span>
#include <string>

#include "framework/contracts/camera_image.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::pictures {

inline constexpr int kMaxSide_px = 8192;

// PNG or JPEG, as the first bytes say.
[[nodiscard]] CameraImage unpacked(std::span<const std::uint8_t> bytes);

// A sensor_msgs/Image.
struct RawPicture {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::string encoding;    // of sensor_msgs/image_encodings: "mono8", "rgb8", "bayer_rggb8", ...
  std::uint32_t step = 0;  // bytes of a row
  bool is_bigendian = false;
  std::span<const std::uint8_t> data;
};

[[nodiscard]] CameraImage grey_of(const RawPicture& raw);

// The robot's camera of that number.
[[nodiscard]] const CameraModel& camera_of(int number, std::span<const CameraModel> cameras);
// Whether a picture has the size that the robot's file gives its camera.
void check_size(int width_px, int height_px, const CameraModel& camera);

}  // namespace cairn::pictures
