#include "maps/clustering/cluster_levels.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace cairn {

std::vector<ClusterLevel> levels_of(const ClusterTree& tree, const LandmarkGraph& graph) {
  std::vector<ClusterLevel> levels;
  std::unordered_map<LandmarkId, ClusterId> cluster_of(tree.cluster_of.begin(), tree.cluster_of.end());
  for (int level = 1;; ++level) {
    const auto clusters =
        std::ranges::count_if(tree.clusters, [level](const auto& entry) { return entry.second.level == level; });
    if (clusters == 0) return levels;
    std::unordered_set<LandmarkId> boundary;
    for (const auto& [id, route] : graph.routes()) {
      if (cluster_of[route.from] == cluster_of[route.to]) continue;
      boundary.insert(route.from);
      boundary.insert(route.to);
    }
    levels.push_back({static_cast<std::size_t>(clusters), boundary.size()});
    for (auto& [landmark, cluster] : cluster_of) cluster = tree.clusters.at(cluster).parent;
  }
}

}  // namespace cairn
