// Settings of HIMM.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::himm_map {

struct Config {
  double cell_m = 0.05;
  int increment = 3;
  int decrement = 1;
  int certainty_max = 15;
  double range_m = 5.0;
  bool growth = false;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::himm_map
