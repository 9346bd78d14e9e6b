// Something that has echoed, robot frame.
#pragma once

#include "maps/geometry/pose.hpp"

namespace cairn {

struct SeenPoint {
  Point at{0.0, 0.0};
  double closing_mps = 0.0;    // how fast it comes nearer beyond what the robot's own motion explains
  double until_fired_s = 0.0;  // before its transducer fires again
};

// Nothing in a building comes nearer faster than that.
inline constexpr double kFastestMover_mps = 1.2;

// Speeds that differences of two ranges say, beyond noise: 0 within it, and for what nothing in a building does.
[[nodiscard]] double closing_speed_mps(double expected_m, double range_m, double passed_s);

}  // namespace cairn
