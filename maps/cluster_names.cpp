#include "maps/cluster_names.hpp"

#include <algorithm>

namespace cairn {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string own_name(const Cluster& cluster, const std::string& anchor) {
  return "C" + std::to_string(cluster.level) + ":" + anchor;
}

}  // namespace

std::string label_of(const Cluster& cluster, const LandmarkGraph& graph) {
  if (!cluster.name.empty()) return cluster.name;
  const Landmark* const anchor = graph.find(cluster.anchor);
  return own_name(cluster, anchor == nullptr ? "L" + std::to_string(cluster.anchor) : label_of(*anchor));
}

const Cluster* find_cluster(const ClusterTree& tree, const LandmarkGraph& graph, const std::string& name) {
  const auto named_by = [&](auto is_named) -> const Cluster* {
    const auto found = std::ranges::find_if(tree.clusters, [&](const auto& entry) { return is_named(entry.second); });
    return found == tree.clusters.end() ? nullptr : &found->second;
  };
  const std::size_t colon = name.find(':');
  if (looks_like_id(name) && colon != std::string::npos) {
    const Landmark* const anchor = graph.find_by_name(name.substr(colon + 1));
    if (anchor == nullptr) return nullptr;
    return named_by([&](const Cluster& cluster) {
      return cluster.anchor == anchor->id && name.substr(1, colon - 1) == std::to_string(cluster.level);
    });
  }
  return named_by([&](const Cluster& cluster) { return !cluster.name.empty() && cluster.name == name; });
}

bool looks_like_id(std::string_view name) {
  if (name.size() < 2 || (name[0] != 'L' && name[0] != 'C') || !is_digit(name[1])) return false;
  const auto behind = std::ranges::find_if_not(name.substr(1), is_digit);
  return behind == name.end() || (name[0] == 'C' && *behind == ':');
}

}  // namespace cairn
