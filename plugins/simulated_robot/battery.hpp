// The robot's battery: what is left falls evenly, by standing and by the more the faster it goes.
#pragma once

#include <optional>

#include "plugins/simulated_robot/config.hpp"

namespace cairn {

class Battery {
 public:
  // Without settings it never runs empty.
  explicit Battery(const std::optional<BatteryConfig>& config)
      : config_(config), ratio_(config ? config->start_ratio : 1.0) {}

  // speed_ratio: of the robot's top speed.
  void drain(double speed_ratio, double for_s);
  [[nodiscard]] bool is_empty() const { return ratio_ <= 0.0; }
  // What is left; none without settings.
  [[nodiscard]] std::optional<double> reading() const { return config_ ? std::optional(ratio_) : std::nullopt; }

 private:
  std::optional<BatteryConfig> config_;
  double ratio_;
};

}  // namespace cairn
