#include "maps/pose_graph/sensor_errors.hpp"

#include <cmath>

namespace cairn {
namespace {

double chi2_of(double value, double sigma) {
  return sigma > 0.0 ? value * value / (sigma * sigma) : 0.0;
}

}  // namespace

bool is_valid(const ExpectedErrors& expected) {
  const auto is_sigma = [](double value) { return std::isfinite(value) && value >= 0.0; };
  return is_sigma(expected.length_ratio) && is_sigma(expected.turn_ratio) && is_sigma(expected.compass_rad) &&
         is_sigma(expected.local_compass_rad) && expected.local_kept_ratio >= 0.0 && expected.local_kept_ratio < 1.0;
}

double innovation_sigma_rad(const ExpectedErrors& expected) {
  return expected.local_compass_rad * std::sqrt(1.0 - expected.local_kept_ratio * expected.local_kept_ratio);
}

double chi2_of(const ExpectedErrors& expected, const SensorErrors& errors) {
  double chi2 = chi2_of(errors.length_ratio, expected.length_ratio) + chi2_of(errors.turn_ratio, expected.turn_ratio) +
                chi2_of(errors.compass_rad, expected.compass_rad);
  const std::vector<double>& local_rad = errors.local_compass_rad;
  if (!local_rad.empty()) chi2 += chi2_of(local_rad.front(), expected.local_compass_rad);
  for (std::size_t i = 1; i < local_rad.size(); ++i)
    chi2 += chi2_of(local_rad[i] - expected.local_kept_ratio * local_rad[i - 1], innovation_sigma_rad(expected));
  return chi2;
}

ErrorRows::ErrorRows(const ExpectedErrors& expected, std::size_t groups, int first) : end(first) {
  if (expected.length_ratio > 0.0) length = end++;
  if (expected.turn_ratio > 0.0) turn = end++;
  if (expected.compass_rad > 0.0) compass = end++;
  if (expected.local_compass_rad <= 0.0 || groups == 0) return;
  first_local = end;
  end += static_cast<int>(groups);
}

}  // namespace cairn
