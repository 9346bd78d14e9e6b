#include "framework/host/statistics.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace cairn {

Estimate estimate_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  if (values.size() == 1) return {mean, 0.0};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const boost::math::students_t distribution(count - 1.0);
  return {mean, boost::math::quantile(distribution, 0.975) * std::sqrt(squares / (count - 1.0) / count)};
}

}  // namespace cairn
