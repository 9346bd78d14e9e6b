// What one echo, or its absence, says about one cell (METHOD 2.1, Konolige's form).
//
//   alpha = alpha_max (1 - min(1, r / alpha_range)) (1 - (bearing / half_beam)^2)
//   delta = delta_m + delta_per_m r
//   lambda(echo at D) = 1 - alpha Phi(z) + alpha phi(z) / (F delta),  z = (D - r) / delta
//   lambda(no echo)   = 1 - alpha Phi((R_max - r) / delta)
#pragma once

namespace cairn::bayes_map {

struct BeamModel {
  double alpha_max = 0.6;
  double alpha_range_m = 4.0;
  double delta_m = 0.01;
  double delta_per_m = 0.015;
  double false_echo_per_m = 1.0;

  // Chance that a target at this range and bearing echoes; a ray (half_beam 0) has no bearing.
  [[nodiscard]] double alpha(double range_m, double bearing_rad, double half_beam_rad) const;
  [[nodiscard]] double delta(double range_m) const { return delta_m + delta_per_m * range_m; }
  [[nodiscard]] double lambda_of_echo(double alpha, double range_m, double echo_m) const;
  [[nodiscard]] double lambda_of_silence(double alpha, double range_m, double max_m) const;

  // The farthest cell that a reading says anything about: 3 delta behind the echo (or at max_m when
  // there is none), and nowhere beyond alpha_range_m.
  [[nodiscard]] double reach_of_echo_m(double echo_m) const;
  [[nodiscard]] double reach_of_silence_m(double max_m) const;
};

}  // namespace cairn::bayes_map
