// Settings of the module `april_tags`. Sizes are those of the square whose corners are detected (docs/markers.md).
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn::april_tags {

// Tags that are printed in a size of their own.
struct SizeConfig {
  MarkerFamily family = MarkerFamily::tag36h11;
  int first = 0;
  int last = 0;
  double size_m = 0.16;
  static void describe(Fields<SizeConfig>& fields);
};

struct Config {
  std::vector<MarkerFamily> families{MarkerFamily::tag36h11};
  double size_m = 0.16;
  std::vector<SizeConfig> sizes;
  double decimate = 1.0;
  int threads = 1;
  double min_decision_margin = 25.0;
  double corner_noise_px = 0.15;
  double min_position_error_m = 0.01;
  double min_angle_error_rad = radians(0.5);
  static void describe(Fields<Config>& fields);
};

// Throws ConfigError.
void check_sizes(const Config& config);
[[nodiscard]] double size_of(const Config& config, const MarkerId& marker);

}  // namespace cairn::april_tags
