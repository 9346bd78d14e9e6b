// Names that people give to landmarks and clusters.
#pragma once

#include <string>

#include "maps/clustering/cluster_tree.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// Why a name cannot be given, or an empty text: a name must find what it names, so wherever a place is asked for it may
// mean nothing else. own: the name of what is to be named, among those of the graph or the tree; null: of none of them.
[[nodiscard]] std::string refusal_of_name(const std::string& name, const LandmarkGraph& graph,
                                          const ClusterTree& clusters, const std::string* own);

// Gives what a landmark's or a cluster's id or name finds that name, or takes its name away where that is empty.
// Returns the id: "L17", "C1:L17". Throws std::runtime_error: there is nothing of that name (with the nearest), or the
// name cannot be given.
std::string give_name(SavedMap& map, const std::string& what, const std::string& name);

}  // namespace cairn
