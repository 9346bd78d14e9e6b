// What one echo, or its absence, says about one cell (docs/method.md 2.1, Konolige's form).
//
//   alpha = alpha_max (1 - min(1, r / alpha_range)) (1 - (bearing / half_beam)^2)
//   delta = delta_m + delta_per_m r
//   lambda(echo at D) = 1 - alpha Phi(z) + alpha phi(z) / (F delta),  z = (D - r) / delta
//   lambda(no echo)   = 1 - alpha Phi((R_max - r) / delta)
#pragma once

#include "framework/config/fields.hpp"

namespace cairn::sonar_model {

struct BeamModel {
  double alpha_max = 0.6;
  double alpha_range_m = 4.0;
  double delta_m = 0.01;
  double delta_per_m = 0.015;
  double false_echo_per_m = 1.0;

  // Probability that a target at this range and bearing echoes; a ray (half_beam 0) has no bearing.
  [[nodiscard]] double alpha(double range_m, double bearing_rad, double half_beam_rad) const;
  [[nodiscard]] double delta(double range_m) const { return delta_m + delta_per_m * range_m; }
  [[nodiscard]] double lambda_of_echo(double alpha, double range_m, double echo_m) const;
  [[nodiscard]] double lambda_of_silence(double alpha, double range_m, double max_m) const;

  // The farthest cell that a reading says anything about: 3 delta behind the echo (or at max_m when
  // there is none), and nowhere beyond alpha_range_m.
  [[nodiscard]] double reach_of_echo_m(double echo_m) const;
  [[nodiscard]] double reach_of_silence_m(double max_m) const;
};

// The model's settings, for configurations that have a BeamModel as their base.
template <class Config>
void describe_beam_model(Fields<Config>& fields) {
  fields.number("alpha_max", &Config::alpha_max, {0.01, 0.99}, "",
                "chance that a target on the axis, close by, echoes");
  fields.number("alpha_range_m", &Config::alpha_range_m, {0.1, 100.0}, "m",
                "range at which that chance has fallen to 0; cells beyond learn nothing. A reading without an echo "
                "frees the beam as far as this and the sensor's max_m; readings under its min_m and NaN say nothing");
  fields.number("delta_m", &Config::delta_m, {0.001, 1.0}, "m", "range error at range 0, standard deviation");
  fields.number("delta_per_m", &Config::delta_per_m, {0.0, 0.3}, "", "what the range error grows by each metre");
  fields.number("false_echo_per_m", &Config::false_echo_per_m, {0.01, 100.0}, "1/m",
                "density F of echoes that come from anything else than the cell; smaller makes echoes count more");
}

}  // namespace cairn::sonar_model
