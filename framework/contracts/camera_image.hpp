// One picture of a camera.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace cairn {

// Copies share the pixels, which never change.
struct CameraImage {
  int camera = 0;        // index in RobotModel::cameras
  double stamp_s = 0.0;  // of the exposure, by the observation's clock
  int width_px = 0;
  int height_px = 0;
  std::shared_ptr<const std::vector<std::uint8_t>> grey;  // width_px * height_px, row by row from the upper left
};

}  // namespace cairn
