// The shortest forward path on straight lines and circles of one radius (Dubins 1957).
//
// OMPL 1.5.2's DubinsStateSpace has the same words, but ends the program by an assertion on long motions whose turns
// nearly vanish (shown by tests/planners/ompl/pose/kinematic_spaces_test.cpp).
#pragma once

#include "planners/common/pose_space/motion.hpp"

namespace cairn {

// Of the words CSC and CCC the shortest whose end agrees with `to` within tolerance (metres and radians).
// Where circles all but meet, a word that rounding keeps from its end is passed over for the next longer.
[[nodiscard]] Motion dubins_motion(const Pose2& from, const Pose2& to, double radius_m, double tolerance = 1e-9);
// Of that motion, at less cost.
[[nodiscard]] double dubins_length_m(const Pose2& from, const Pose2& to, double radius_m, double tolerance = 1e-9);

}  // namespace cairn
