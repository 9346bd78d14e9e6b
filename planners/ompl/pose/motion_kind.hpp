// How a robot moves, and which planners take it.
#pragma once

#include <cstdint>

#include "planners/ompl/search/algorithms.hpp"

namespace cairn {

enum class MotionKind : std::uint8_t {
  disc,          // in any direction; no heading (planned in the plane)
  differential,  // turns on the spot, drives straight, turns on the spot
  dubins,        // forwards, straight or on circles
  reeds_shepp,   // the same, forwards and backwards
};

// Which of OMPL's planners find routes for a robot that moves so (a differential one that drives forwards
// only), all of whose motions fit. Of the others some never do, some return paths that touch, some abort.
[[nodiscard]] bool works_with(MotionKind kind, Algorithm algorithm);

}  // namespace cairn
