// One search by a planner of OMPL over a problem that is set up.
//
// Deterministic for a seed, from any number of threads: OMPL seeds its generators from one process-wide
// source, so one search runs at a time, with that source set anew; only those whose answers do not hang on it
// (seeded_rrt_star.hpp) run side by side. States are drawn by the problem's own samplers.
//
// What cannot be had: the latter shift that source all the same. Every planner and every state sampler of OMPL holds
// a generator as a member, and each takes a seed from the source as it is made, wanted or not. So a search by one of
// OMPL's own planners may answer differently while searches by the default algorithm run in the same process.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/geometric/PathGeometric.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "planners/ompl/search/algorithm_parameters.hpp"

namespace cairn {

struct SearchRules {
  Algorithm algorithm = Algorithm::rrt_connect;
  const AlgorithmParameters& parameters;
  std::int64_t iterations = 0;  // how often the termination condition may be asked
  bool simplify = true;
  std::uint64_t seed = 1;
};

struct SearchAnswer {
  std::shared_ptr<ompl::geometric::PathGeometric> path;  // null: none found
  bool exact = false;                                    // otherwise it ends short of the goal
  bool interrupted = false;                              // by the budget's deadline or cancel flag
};

// The same by a planner that draws nothing from OMPL's process-wide seeds.
[[nodiscard]] SearchAnswer search_by(ompl::base::Planner& planner, const ompl::base::ProblemDefinitionPtr& problem,
                                     const SearchRules& rules, const Budget& budget);

// `known` (optional): a solution to begin with, taken by Algorithm::any_angle_rrt_star alone.
[[nodiscard]] SearchAnswer search(const ompl::base::SpaceInformationPtr& space,
                                  const ompl::base::ProblemDefinitionPtr& problem, const SearchRules& rules,
                                  const Budget& budget, const std::vector<const ompl::base::State*>& known = {});

}  // namespace cairn
