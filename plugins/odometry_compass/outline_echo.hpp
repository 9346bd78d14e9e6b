// The range that a transducer should read of a known outline, and how that changes as it is moved.
#pragma once

#include <optional>

#include "maps/geometry/contour.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::odometry_compass {

struct ExpectedEcho {
  double range_m = 0.0;
  Point per_position{0.0, 0.0};  // d range / d position of the transducer, in the frame it was given in
  double per_heading_m = 0.0;    // d range / d its heading; 0 for what a cone hears: the nearest point stays the same
};

// A cone hears the nearest point of the outline that faces it squarely (the foot of a perpendicular, a round face) or
// is a corner, inside its half-beam; none when the nearest one is at its rim, where an echo is a matter of loudness
// (Kuc and Siegel 1987). A ray (half_beam_rad 0) meets the outline where it crosses it first; none at a grazing
// crossing. None from inside.
[[nodiscard]] std::optional<ExpectedEcho> expected_echo(const Contour& contour, const Pose2& T_contour_sensor,
                                                        double half_beam_rad);

}  // namespace cairn::odometry_compass
