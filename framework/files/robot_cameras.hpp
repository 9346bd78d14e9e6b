// The cameras of a robot file. Throws ConfigError.
#pragma once

#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::robot_config {

struct CameraConfig : CameraModel {
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;
  std::vector<double> focal_px;
  std::vector<double> centre_px;
  std::vector<double> distortion_numbers;
  static void describe(Fields<CameraConfig>& fields);
};

// value: the map that the config was loaded from.
[[nodiscard]] CameraModel camera_of(const CameraConfig& config, const ConfigValue& value);

}  // namespace cairn::robot_config
