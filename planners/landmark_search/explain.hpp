// Why a way over the landmark graph is what it is.
#pragma once

#include "framework/contracts/planner.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"

namespace cairn {

// Searches a second time, with every closed route open, to say what the closed ones cost.
[[nodiscard]] PlanExplanation explanation_of(const Way& way, const RouteQuery& query, const PlanRequest& request,
                                             const LandmarkGraph& graph, const Hierarchy& hierarchy,
                                             const RouteCost& cost, HierarchySearch& search, const Budget& budget);

}  // namespace cairn
