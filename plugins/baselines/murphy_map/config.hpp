// Settings of the textbook map.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::murphy_map {

struct Config {
  double cell_m = 0.05;
  double clamp_nat = 4.0;
  double range_m = 5.0;
  double tolerance_m = 0.05;
  double max_occupied_p = 0.98;
  bool keep_sign = false;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::murphy_map
