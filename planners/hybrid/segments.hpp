// What a path is made of, for whoever asks where it came from.
#pragma once

#include <vector>

#include "planners/common/disc_space/routes.hpp"

namespace cairn {

// The pieces of a route whose points name one of `parts` each (or kSeveralParts: a cut). Their lengths are those on
// the route and add up to its own; neighbours of one part are one piece, parts without length none.
[[nodiscard]] std::vector<PathSegment> segments_of(const std::vector<PartedPoint>& route,
                                                   const std::vector<PathSegment>& parts);

// The pieces of a path that joins the routes' trajectories, or where there is none the landmarks' standing places: of
// a graph planner's answer.
[[nodiscard]] std::vector<PathSegment> segments_of_graph(const PlanResult& found, const LandmarkGraph& graph);

}  // namespace cairn
