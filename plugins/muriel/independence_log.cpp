#include "plugins/muriel/independence_log.hpp"

#include <cmath>
#include <numbers>

namespace cairn::muriel {

int bucket_of(double direction_rad, int bearings) {
  const double buckets = direction_rad / (2.0 * std::numbers::pi) * bearings;
  const int bucket = static_cast<int>(std::lround(buckets)) % bearings;
  return bucket < 0 ? bucket + bearings : bucket;
}

Weights weights_of(const Config& config) {
  if (config.log == LogPolicy::off) return {1.0, 1.0, 1.0, 1.0};
  Weights weights{};  // 0 once the log is full
  const int readings = config.log == LogPolicy::paper ? 1 : config.log_readings;
  for (int n = 0; n < readings; ++n) weights[static_cast<std::size_t>(n)] = std::pow(config.log_fall, n);
  return weights;
}

}  // namespace cairn::muriel
