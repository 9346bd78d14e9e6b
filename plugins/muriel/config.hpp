// Settings of the MURIEL map (docs/method.md 2).
#pragma once

#include "framework/config/fields.hpp"
#include "plugins/common/sonar_model/beam_model.hpp"

namespace cairn::muriel {

inline constexpr int kMaxSectors = 32;

enum class LogPolicy { off, paper, counted };

// A beam model whose settings stand beside the others in the mission file. The defaults are the best
// found on six drives (docs/results/mapping.md).
struct Config : sonar_model::BeamModel {
  double cell_m = 0.05;
  double clamp_nat = 4.0;

  bool specular = true;
  double specular_prior = 0.3;
  double specular_per_m = 0.2;
  int specular_sectors = 7;
  double believed_p = 0.6;

  LogPolicy log = LogPolicy::counted;
  int log_bearings = 32;
  int log_readings = 3;
  double log_fall = 0.5;

  Config() { false_echo_per_m = 2.0; }
  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::muriel
