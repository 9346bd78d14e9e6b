#include "maps/cluster_tree.hpp"

#include <algorithm>

namespace cairn {
namespace {

std::string given_label(const Cluster& cluster, const LandmarkGraph& graph) {
  const Landmark* const anchor = graph.find(cluster.anchor);
  return "C" + std::to_string(cluster.level) + ":" +
         (anchor != nullptr ? label_of(*anchor) : "L" + std::to_string(cluster.anchor));
}

}  // namespace

std::string label_of(const Cluster& cluster, const LandmarkGraph& graph) {
  return cluster.name.empty() ? given_label(cluster, graph) : cluster.name;
}

const Cluster* find_cluster(const ClusterTree& tree, const LandmarkGraph& graph, const std::string& label) {
  const auto find = [&](auto is_it) -> const Cluster* {
    const auto found = std::find_if(tree.clusters.begin(), tree.clusters.end(), is_it);
    return found == tree.clusters.end() ? nullptr : &found->second;
  };
  if (label.empty()) return nullptr;
  const Cluster* const named = find([&](const auto& entry) { return entry.second.name == label; });
  return named != nullptr ? named : find([&](const auto& entry) { return given_label(entry.second, graph) == label; });
}

}  // namespace cairn
