#include "maps/clustering/clustering.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "maps/clustering/cluster_builder.hpp"
#include "maps/clustering/cluster_former.hpp"
#include "maps/clustering/cluster_upkeep.hpp"

namespace cairn {
namespace {

ClusterSizes without_levels(ClusterSizes sizes) {
  sizes.from = SIZE_MAX;
  sizes.large_from = SIZE_MAX;
  return sizes;
}

}  // namespace

std::int32_t ClusterSizes::most(int level) const {
  std::int64_t most = leaf;
  for (int l = 1; l < level && most < std::numeric_limits<std::int32_t>::max(); ++l) most *= growth;
  return static_cast<std::int32_t>(std::min<std::int64_t>(most, std::numeric_limits<std::int32_t>::max()));
}

std::int32_t ClusterSizes::most_by_length(std::size_t landmarks) const {
  return std::min(leaf, static_cast<std::int32_t>(std::lround(2.0 * std::sqrt(static_cast<double>(landmarks)))));
}

int ClusterSizes::levels_for(std::size_t landmarks) const {
  int levels = 0;
  if (landmarks < from) return levels;
  if (landmarks < large_from) return 1;
  while (2 * static_cast<std::size_t>(most(levels + 1)) <= landmarks) ++levels;
  return std::max(levels, 1);
}

Clustering::Clustering(const Network& network, const ClusterSizes& sizes, const Proposal& propose,
                       const PassageWidths& widths)
    : sizes_(sizes) {
  if (sizes.leaf < 2 || sizes.growth < 2)
    throw std::invalid_argument("ClusterSizes: leaf and growth must be at least 2");
  is_small_ = network.landmarks() < sizes.large_from;
  if (is_small_)
    ClusterFormer(*this, network, propose, widths).form();
  else
    ClusterBuilder(*this, network, propose).build();
}

ClusterIndex Clustering::cluster_of(VertexIndex v, int level) const {
  ClusterIndex cluster = leaf_of(v);
  for (int l = 1; l < level && cluster != kNoCluster; ++l) cluster = nodes_[cluster].parent;
  return cluster;
}

std::vector<ClusterIndex> Clustering::of_level(int level) const {
  std::vector<ClusterIndex> clusters;
  for (ClusterIndex c = 0; c < end(); ++c)
    if (nodes_[c].level == level) clusters.push_back(c);
  return clusters;
}

ClusterIndex Clustering::add(int level, ClusterIndex parent) {
  ClusterIndex cluster = end();
  if (free_.empty()) {
    nodes_.emplace_back();
  } else {
    cluster = free_.back();
    free_.pop_back();
  }
  ClusterNode& node = nodes_[cluster];
  node = {};
  node.level = level;
  node.parent = parent;
  node.id = next_id_++;
  if (parent != kNoCluster) nodes_[parent].members.push_back(cluster);
  return cluster;
}

void Clustering::remove(ClusterIndex cluster) {
  ClusterNode& node = nodes_[cluster];
  if (node.parent != kNoCluster) std::erase(nodes_[node.parent].members, cluster);
  node = {};
  free_.push_back(cluster);
}

void Clustering::adopt(ClusterIndex cluster, std::span<const std::uint32_t> members) {
  ClusterNode& node = nodes_[cluster];
  node.members.assign(members.begin(), members.end());
  std::sort(node.members.begin(), node.members.end());
  node.landmarks = 0;
  for (const std::uint32_t member : node.members) {
    (node.level == 1 ? leaf_[member] : nodes_[member].parent) = cluster;
    node.landmarks += node.level == 1 ? 1 : nodes_[member].landmarks;
  }
}

void Clustering::find_boundary(const Network& network, ClusterIndex cluster) {
  ClusterNode& node = nodes_[cluster];
  node.boundary.clear();
  const auto leaves = [&](const std::vector<Arc>& arcs) {
    return std::any_of(arcs.begin(), arcs.end(),
                       [&](const Arc& arc) { return cluster_of(arc.other, node.level) != cluster; });
  };
  const auto look_at = [&](VertexIndex v) {
    if (leaves(network.out(v)) || leaves(network.in(v))) node.boundary.push_back(v);
  };
  for (const std::uint32_t member : node.members)
    if (node.level == 1)
      look_at(member);
    else
      for (const VertexIndex v : nodes_[member].boundary) look_at(v);
  std::sort(node.boundary.begin(), node.boundary.end());
}

void Clustering::find_anchor(const Network& network, ClusterIndex cluster) {
  ClusterNode& node = nodes_[cluster];
  const VertexIndex present = network.vertex_of(node.anchor);
  if (present != kNoVertex && cluster_of(present, node.level) == cluster) return;
  const auto weight = [&](std::uint32_t member) {
    return node.level == 1 ? network.out(member).size() + network.in(member).size()
                           : static_cast<std::size_t>(nodes_[member].landmarks);
  };
  const auto landmark = [&](std::uint32_t member) {
    return node.level == 1 ? network.landmark_of(member) : nodes_[member].anchor;
  };
  const std::uint32_t best =
      *std::min_element(node.members.begin(), node.members.end(), [&](std::uint32_t a, std::uint32_t b) {
        return weight(a) != weight(b) ? weight(a) > weight(b) : landmark(a) < landmark(b);
      });
  node.anchor = landmark(best);
}

void Clustering::clear() {
  nodes_.clear();
  free_.clear();
  leaf_.clear();
  levels_ = 0;
}

void Clustering::drop_level() {
  for (const ClusterIndex cluster : of_level(levels_)) {
    for (const std::uint32_t member : nodes_[cluster].members)
      (levels_ == 1 ? leaf_[member] : nodes_[member].parent) = kNoCluster;
    nodes_[cluster] = {};
    free_.push_back(cluster);
  }
  max_levels_ = --levels_;
}

// Not to and fro between small and large with every landmark that comes and goes.
Clustering::Upkeep Clustering::follow(const Network& network, std::span<const VertexIndex> vertices,
                                      const PassageWidths& widths) {
  const std::size_t fewer = sizes_.large_from - sizes_.large_from / 5;
  const bool was_small = is_small_;
  is_small_ = network.landmarks() < (is_small_ ? sizes_.large_from : fewer);
  if (is_small_) {
    ClusterFormer(*this, network, propose_by_metis, widths).form();
    return {{}, true};
  }
  Upkeep upkeep = ClusterUpkeep(*this, network).follow(vertices);
  upkeep.levels_changed = upkeep.levels_changed || was_small;
  return upkeep;
}

ClusterTree Clustering::tree(const Network& network) const {
  ClusterTree tree;
  tree.next_id = next_id_;
  for (const ClusterNode& node : nodes_)
    if (node.level > 0) {
      const ClusterId parent = node.parent == kNoCluster ? 0 : nodes_[node.parent].id;
      tree.clusters.emplace(node.id, Cluster{node.id, node.level, parent, node.anchor, node.name});
    }
  if (levels_ == 0) return tree;
  for (VertexIndex v = 0; v < network.end(); ++v)
    if (network.landmark_of(v) != 0) tree.cluster_of.emplace(network.landmark_of(v), nodes_[leaf_[v]].id);
  return tree;
}

// Takes over what is sound: a chain of clusters of rising level for each landmark; whatever else there is in the
// tree has no landmarks and is left out. The upkeep then looks at every cluster.
Clustering::Clustering(const Network& network, const ClusterSizes& sizes, const ClusterTree& saved,
                       const PassageWidths& widths)
    : Clustering(network, saved.cluster_of.empty() ? sizes : without_levels(sizes), propose_by_metis, widths) {
  if (saved.cluster_of.empty()) return;
  sizes_ = sizes;
  is_small_ = network.landmarks() < sizes.large_from;
  if (is_small_)
    ClusterFormer(*this, network, propose_by_metis, widths).restore(saved);
  else
    ClusterUpkeep(*this, network).restore(saved);
}

}  // namespace cairn
