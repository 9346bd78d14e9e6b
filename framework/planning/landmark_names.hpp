// Names that people give to landmarks and clusters.
#pragma once

#include <string>

#include "maps/clustering/cluster_tree.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// Why a name cannot be given, or an empty text: a name must find what it names, so wherever a place is asked for it may
// mean nothing else. own: the name of what is to be named, among those of the graph or the tree; null: of none of them.
[[nodiscard]] std::string refusal_of_name(const std::string& name, const LandmarkGraph& graph,
                                          const ClusterTree& clusters, const std::string* own);

}  // namespace cairn
