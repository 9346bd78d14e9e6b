#include "plugins/common/sonar_model/beam_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::sonar_model {
namespace {

// Beyond these Phi is 1 and phi is 0 to the last bit of any increment; most cells of a cone are there.
constexpr double kFarBefore = 8.5;

double normal_density(double z) {
  return std::exp(-0.5 * z * z) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
}
double normal_integral(double z) {
  return z > kFarBefore ? 1.0 : 0.5 * std::erfc(-z * (0.5 * std::numbers::sqrt2));
}

}  // namespace

double BeamModel::alpha(double range_m, double bearing_rad, double half_beam_rad) const {
  const double off_axis = half_beam_rad > 0.0 ? bearing_rad / half_beam_rad : 0.0;
  return alpha_max * (1.0 - std::min(1.0, range_m / alpha_range_m)) * (1.0 - off_axis * off_axis);
}

double BeamModel::lambda_of_echo(double alpha, double range_m, double echo_m) const {
  const double delta_here_m = delta(range_m);
  const double z = (echo_m - range_m) / delta_here_m;
  if (z > kFarBefore) return 1.0 - alpha;
  return 1.0 - alpha * normal_integral(z) + alpha * normal_density(z) / (false_echo_per_m * delta_here_m);
}

double BeamModel::lambda_of_silence(double alpha, double range_m, double max_m) const {
  return 1.0 - alpha * normal_integral((max_m - range_m) / delta(range_m));
}

double BeamModel::reach_of_echo_m(double echo_m) const {
  return std::min(alpha_range_m, (echo_m + 3.0 * delta_m) / (1.0 - 3.0 * delta_per_m));
}

double BeamModel::reach_of_silence_m(double max_m) const {
  return std::min(alpha_range_m, max_m);
}

}  // namespace cairn::sonar_model
