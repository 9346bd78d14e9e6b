// What tests ask of a motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/common/pose_space/motion.hpp"

namespace cairn::test {

// Of all elements, without signs.
inline double total_turn_rad(const Motion& motion) {
  double sum_rad = 0.0;
  for (const MotionElement& element : motion.elements()) sum_rad += std::abs(element.turn_rad);
  return sum_rad;
}

// Of its arcs; infinite without one.
inline double min_radius_m(const Motion& motion) {
  double min_m = std::numeric_limits<double>::infinity();
  for (const MotionElement& element : motion.elements())
    if (!element.is_turn_on_the_spot() && element.turn_rad != 0.0)
      min_m = std::min(min_m, std::abs(element.signed_radius_m()));
  return min_m;
}

// Of a motion that counts a radian on the spot as spot_turn_m.
inline Motion first_part(const Motion& motion, double s_m, double spot_turn_m = 1.0) {
  Motion part(motion.start(), {}, spot_turn_m);
  for (const MotionElement& element : motion.elements()) {
    const double extent_m = motion.extent_of(element);
    part.append(s_m < extent_m ? element.share(std::max(s_m, 0.0) / extent_m) : element);
    s_m -= extent_m;
    if (s_m < 0.0) break;
  }
  return part;
}

}  // namespace cairn::test
