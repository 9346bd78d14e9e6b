// The segments of a path by where they came from.
#pragma once

#include <vector>

#include "framework/contracts/planner.hpp"
#include "planners/common/disc_space/routes.hpp"

namespace cairn {

// The segments of a route whose points name one of `parts` each (or kSeveralParts: a cut). Their lengths are those on
// the route and add up to its own; neighbours of one part are one segment, parts without length none.
[[nodiscard]] std::vector<PathSegment> segments_of(const std::vector<PartedPoint>& route,
                                                   const std::vector<PathSegment>& parts);

// The segments of a path that joins the routes' trajectories, or where there is none the landmarks' approach poses: of
// a route planner's answer.
[[nodiscard]] std::vector<PathSegment> segments_of_graph(const PlanResult& found, const LandmarkGraph& graph);

}  // namespace cairn
