// A recorded log with the pictures that were taken beside it. Plugin `picture_log`, kind sensor, around the sensor that
// reads the log (docs/markers.md).
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"

namespace cairn::picture_log {

struct CameraPictures {
  std::filesystem::path list;
  int camera = 0;
  double offset_s = 0.0;

  static void describe(Fields<CameraPictures>& fields);
};

struct Config {
  PluginChoice log;
  std::vector<CameraPictures> pictures;

  static void describe(Fields<Config>& fields);
};

// Without a wish for images the log alone. Throws ConfigError with the place in the list.
[[nodiscard]] std::unique_ptr<Sensor> with_pictures(std::shared_ptr<Sensor> log, const Config& config,
                                                    const SensorContext& context);

}  // namespace cairn::picture_log
