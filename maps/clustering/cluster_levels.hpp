// How a landmark graph is divided, level by level.
#pragma once

#include <cstddef>
#include <vector>

#include "maps/clustering/cluster_tree.hpp"

namespace cairn {

struct ClusterLevel {
  std::size_t clusters = 0;
  std::size_t boundary = 0;  // landmarks with a route, open or closed, to or from another cluster of this level
};

// Lowest level first; empty when the tree is. Linear in landmarks and routes, times the levels.
[[nodiscard]] std::vector<ClusterLevel> levels_of(const ClusterTree& tree, const LandmarkGraph& graph);

}  // namespace cairn
