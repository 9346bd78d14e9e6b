// How many routes a graph has, for people.
#pragma once

#include <string>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// "6 routes (3 pairs both ways)", "5 routes (2 pairs both ways, 1 one way)", "1 route (one way)", "0 routes". A route
// leads one way, and a picture shows those of a pair of landmarks as one line. O(n log n).
[[nodiscard]] std::string counted_routes(const LandmarkGraph& graph);

}  // namespace cairn
