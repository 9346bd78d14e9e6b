// The answer made of a path that was found: re-checked against the grid.
#pragma once

#include "planners/ompl/pose/pose_problem.hpp"
#include "planners/ompl/pose/pose_setup.hpp"

namespace cairn {

struct FoundPath {
  std::vector<Pose2> states;
  bool exact = false;
  bool interrupted = false;
  std::string how;
};

// The re-check is straight from the grid, over the whole of every motion; throws std::logic_error when it refuses.
// A path of hundreds of metres takes long to check: a cancelled budget ends it with a refusal, a deadline does not.
[[nodiscard]] PathResult result_of(const PoseProblem& problem, const PoseSetup& setup, const WorldView& world,
                                   const StartPlace& start, const GoalPlace& goal, const FoundPath& found,
                                   const Budget& budget);

}  // namespace cairn
