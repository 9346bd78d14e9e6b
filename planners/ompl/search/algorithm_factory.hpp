// Makes OMPL planners by name. The only file that sees all of OMPL's planner headers is its .cpp.
#pragma once

#include <ompl/base/Planner.h>

#include "planners/ompl/search/algorithms.hpp"

namespace cairn {

[[nodiscard]] ompl::base::PlannerPtr make_algorithm(Algorithm algorithm, const ompl::base::SpaceInformationPtr& space);

}  // namespace cairn
