// The names of clusters: "C<level>:<label of the anchor>" always, and one that the user gave.
#pragma once

#include <string>
#include <string_view>

#include "maps/cluster_tree.hpp"

namespace cairn {

[[nodiscard]] std::string label_of(const Cluster& cluster, const LandmarkGraph& graph);  // its name, or "C1:L17"
// By its user's name, "C1:L17" or "C1:front desk" (the anchor's id or name); null when there is none. Linear.
[[nodiscard]] const Cluster* find_cluster(const ClusterTree& tree, const LandmarkGraph& graph, const std::string& name);
// Whether it is or begins like what Cairn calls things by itself: "L17", "C2:...".
[[nodiscard]] bool looks_like_id(std::string_view name);

}  // namespace cairn
