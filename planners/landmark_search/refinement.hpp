// From a path over levels to one over landmarks and routes, leg by leg, from each level down to the one below.
#pragma once

#include "planners/landmark_search/graph_search.hpp"

namespace cairn {

// Appends the cheapest path through a cluster, between two of its boundary vertices (their numbers there). The path
// ends at the first of them so far. Follows the trees that the overlay keeps: nothing is searched.
void append_passage(const Hierarchy& hierarchy, ClusterIndex cluster, std::size_t from, std::size_t to,
                    GraphPath& path);
// Leaves out what lies between two visits of one landmark: it costs nothing, or the path would not be the cheapest.
void remove_loops(GraphPath& path);

}  // namespace cairn
