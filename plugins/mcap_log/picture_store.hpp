// The pictures of a log, in a nameless temporary file until they are played: there may be gigabytes of them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>

#include "framework/contracts/camera_image.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/exchange/recordings/ros2_read.hpp"

namespace cairn::mcap_log {

struct StoredPicture {
  std::int64_t begin = 0;  // in the file
  std::size_t size = 0;    // bytes
  bool is_packed = false;
  int width_px = 0;
  int height_px = 0;
};

class PictureStore {
 public:
  // Throws std::runtime_error when there can be no such file.
  PictureStore();

  // Throw MessageError when they are no pictures that can be read, std::runtime_error when the file is full.
  [[nodiscard]] StoredPicture add(const exchange::ros2::ImageMessage& message);
  [[nodiscard]] StoredPicture add(const exchange::ros2::CompressedImageMessage& message);

  // Throws std::runtime_error.
  [[nodiscard]] CameraImage read(const StoredPicture& picture) const;

 private:
  [[nodiscard]] StoredPicture write(std::span<const std::uint8_t> bytes, bool is_packed, const CameraImage& image);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::int64_t end_ = 0;
};

// Throws MessageError when the robot's file gives the camera another size.
void check_size(const StoredPicture& picture, const CameraModel& camera);
// Reads it when it is played, as one of the camera of that number.
[[nodiscard]] std::function<CameraImage()> reader_of(std::shared_ptr<const PictureStore> store,
                                                     const StoredPicture& picture, int camera);

}  // namespace cairn::mcap_log
