// Explains a path over the landmark graph.
#pragma once

#include "framework/contracts/route_planner.hpp"
#include "planners/landmark_search/graph_search.hpp"

namespace cairn {

// Searches a second time, with every closed route open, for what the closed ones cost.
[[nodiscard]] RouteExplanation explanation_of(const GraphPath& path, const RouteQuery& query,
                                              const RouteRequest& request, const LandmarkGraph& graph,
                                              const Hierarchy& hierarchy, const RouteCost& cost, GraphSearch& search,
                                              const Budget& budget);

}  // namespace cairn
