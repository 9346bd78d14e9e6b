// Settings of the search for loops.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::submap_correlation {

struct Config {
  double field_sigma_m = 0.12;
  double min_window_m = 1.0;
  double max_window_m = 7.0;
  double window_rad = radians(15.0);
  double min_score = 0.55;
  double min_matched_ratio = 0.6;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::submap_correlation
