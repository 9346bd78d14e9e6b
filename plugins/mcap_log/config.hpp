// Settings of `mcap_log` (docs/logs.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plugins/common/logs/laser.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::mcap_log {

enum class Stamp { header, log };

// Where the sensor of a frame is on the robot.
struct FramePlace {
  std::string frame;
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;

  static void describe(Fields<FramePlace>& fields);
};

// What wins over what the messages say.
struct SonarConfig {
  std::optional<double> half_beam_rad;
  std::optional<double> min_m;
  std::optional<double> max_m;

  static void describe(Fields<SonarConfig>& fields);
};

// The pictures of a camera.
struct ImageTopic {
  std::string topic;
  int camera = 0;

  static void describe(Fields<ImageTopic>& fields);
};

struct Config : log_common::LogRules {
  std::filesystem::path file;
  std::vector<std::string> ranges;
  std::string odometry;
  std::string compass;
  double compass_offset_rad = 0.0;
  std::string odometry_frame = "odom";
  std::string base_frame;
  std::vector<FramePlace> frames;
  std::vector<ImageTopic> images;
  Stamp stamp = Stamp::header;
  SonarConfig sonar;
  log_common::LaserConfig laser;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::mcap_log
