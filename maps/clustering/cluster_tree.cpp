#include "maps/clustering/cluster_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cairn {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string id_label(const Cluster& cluster) {
  return fmt::format("C{}:L{}", cluster.level, cluster.anchor);
}

std::string given_label(const Cluster& cluster, const LandmarkGraph& graph) {
  const Landmark* const anchor = graph.find(cluster.anchor);
  return anchor != nullptr ? fmt::format("C{}:{}", cluster.level, label_of(*anchor)) : id_label(cluster);
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
  if (named != nullptr || !looks_like_id(label)) return named;
  const Cluster* const by_label = find([&](const auto& entry) { return given_label(entry.second, graph) == label; });
  return by_label != nullptr ? by_label : find([&](const auto& entry) { return id_label(entry.second) == label; });
}

std::vector<LandmarkId> members_of(const ClusterTree& tree, ClusterId cluster) {
  std::vector<LandmarkId> members;
  for (const auto& [landmark, leaf] : tree.cluster_of)
    for (ClusterId id = leaf; id != 0; id = tree.clusters.at(id).parent)
      if (id == cluster) members.push_back(landmark);
  return members;
}

std::vector<ListedCluster> listed(const ClusterTree& tree, const LandmarkGraph& graph) {
  std::map<ClusterId, std::vector<LandmarkId>> members;
  for (const auto& [landmark, leaf] : tree.cluster_of)
    for (ClusterId id = leaf; id != 0; id = tree.clusters.at(id).parent) members[id].push_back(landmark);
  std::vector<ListedCluster> list;
  for (const auto& [id, cluster] : tree.clusters) list.push_back({cluster, label_of(cluster, graph), members[id]});
  return list;
}

bool looks_like_id(std::string_view name) {
  if (name.size() < 2 || (name[0] != 'L' && name[0] != 'C') || !is_digit(name[1])) return false;
  const auto behind = std::find_if_not(name.begin() + 1, name.end(), is_digit);
  return behind == name.end() || (name[0] == 'C' && *behind == ':');
}

}  // namespace cairn
