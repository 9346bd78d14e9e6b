// What an experiment's `buildings` says: buildings of one kind, small and large, and what is asked about their maps.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"

namespace cairn {

struct BuildingsConfig {
  std::vector<double> sides_m{100.0, 200.0, 400.0};
  int landmarks = 1000;  // of the largest; the others have as many to the square metre
  double cell_m = 0.05;
  double radius_m = 0.22;
  int pairs = 60;
  int whole_pairs = 20;
  int first_answers = 11;
  static void describe(Fields<BuildingsConfig>& fields);
};

}  // namespace cairn
