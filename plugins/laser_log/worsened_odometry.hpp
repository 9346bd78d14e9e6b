// Odometry of a log made as bad as that of worn wheels, to see what a localizer makes of it: it counts a constant part
// too much or too little, and turns by chance. Derived data.
#pragma once

#include <cstdint>
#include <optional>

#include "framework/config/fields.hpp"
#include "maps/base/portable_random.hpp"

namespace cairn::laser_log {

struct WornWheels {
  double length_ratio = 0.0;
  double rad_per_m = 0.0;
  int seed = 1;

  static void describe(Fields<WornWheels>& fields);
};

class WorsenedOdometry {
 public:
  explicit WorsenedOdometry(const WornWheels& wheels)
      : wheels_(wheels), random_(static_cast<std::uint64_t>(wheels.seed)) {}

  // In the order of the log. The first is as it was; each step after that is longer by the ratio, and turned by a
  // normal deviate that grows with the root of the way. Without errors: what the log says, to the bit.
  [[nodiscard]] Pose2 next(const Pose2& T_odom_robot);

 private:
  [[nodiscard]] double normal();

  WornWheels wheels_;
  PortableRandom random_;
  std::optional<Pose2> T_odom_robot_;  // the log's last one
  Pose2 T_worn_robot_;
};

}  // namespace cairn::laser_log
