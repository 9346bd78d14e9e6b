// Settings of the plain Bayes map (docs/method.md 2).
#pragma once

#include "framework/config/fields.hpp"
#include "plugins/common/sonar_model/beam_model.hpp"

namespace cairn::bayes_map {

// A beam model whose settings stand beside the grid's in the mission file.
struct Config : sonar_model::BeamModel {
  double cell_m = 0.05;
  double clamp_nat = 4.0;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::bayes_map
