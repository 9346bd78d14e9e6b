// A problem for a robot whose heading matters, set up for OMPL.
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

#include "planners/ompl/pose/kinematic_spaces.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

struct PoseProblem {
  KinematicRules rules;
  const PoseSpace& poses;
  Pose2 from;
  std::vector<Pose2> goals;  // any one of them, all at one place
  const PoseDraw& draw;
  const TravelCost& cost;
  double turn_radps = 1.75;  // on the spot, for costs in time
  std::uint64_t seed = 1;
};

// Of a motion: the cost of its path, and turns on the spot by their extent, or by their time.
[[nodiscard]] double cost_of(const PoseProblem& problem, const Motion& motion);

// With starts, goals and objective; borrows the problem.
[[nodiscard]] ompl::base::ProblemDefinitionPtr definition_of(const PoseProblem& problem,
                                                             const ompl::base::SpaceInformationPtr& info);

// The motions between the states of a path.
[[nodiscard]] std::vector<Motion> motions_of(const ompl::base::StateSpace& space, const std::vector<Pose2>& poses);
[[nodiscard]] std::vector<Pose2> poses_of(const ompl::geometric::PathGeometric& path);

}  // namespace cairn
