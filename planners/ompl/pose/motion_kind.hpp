// How a robot moves, and which planners take it.
#pragma once

#include "framework/contracts/path_planner.hpp"
#include "planners/ompl/search/algorithms.hpp"

namespace cairn {

// holonomic: no heading, planned in the plane; differential: turns on the spot, drives straight, turns on the spot.
using MotionKind = PlannerTraits::Kinematics;

// Which of OMPL's planners find routes for a robot that moves so (a differential one that drives forwards
// only), all of whose motions fit. Of the others some never do, some return paths that touch, some abort.
[[nodiscard]] bool works_with(MotionKind kind, Algorithm algorithm);

}  // namespace cairn
