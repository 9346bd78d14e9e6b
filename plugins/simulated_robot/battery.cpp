#include "plugins/simulated_robot/battery.hpp"

#include <algorithm>

namespace cairn {

void Battery::drain(double speed_ratio, double for_s) {
  if (!config_) return;
  const double standing_per_s = 1.0 / config_->standing_s;
  const double used_per_s =
      standing_per_s + std::min(1.0, speed_ratio) * std::max(0.0, 1.0 / config_->driving_s - standing_per_s);
  ratio_ = std::max(0.0, ratio_ - used_per_s * for_s);
}

}  // namespace cairn
