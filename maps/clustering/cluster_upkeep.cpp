#include "maps/clustering/cluster_upkeep.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace cairn {
namespace {

constexpr int kMaxLevels = 32;

// The chain of saved clusters from level 1 up; empty when it is broken.
std::vector<const Cluster*> chain_of(const ClusterTree& saved, ClusterId leaf) {
  std::vector<const Cluster*> chain;
  for (ClusterId id = leaf; id != 0; id = chain.back()->parent) {
    const auto found = saved.clusters.find(id);
    const int level = static_cast<int>(chain.size()) + 1;
    if (found == saved.clusters.end() || found->second.level != level || level > kMaxLevels) return {};
    if (found->second.id != id || id < 0 || id > kMaxSavedId) return {};
    chain.push_back(&found->second);
  }
  return chain;
}

}  // namespace

void ClusterUpkeep::touch(ClusterIndex cluster) {
  touched_.insert(cluster);
  seen_.insert(cluster);
  as_saved_.erase(cluster);
}

// Its parent has other members then, and is to be looked at, whether or not its boundary stays as it is.
void ClusterUpkeep::remove(ClusterIndex cluster) {
  if (const ClusterIndex parent = clustering_.nodes_[cluster].parent; parent != kNoCluster) {
    next_.insert(parent);
    touched_.insert(parent);
  }
  touched_.insert(cluster);
  clustering_.remove(cluster);
}

// Every vertex gets a cluster, alone at first; what becomes of it is seen level by level.
void ClusterUpkeep::place(std::span<const VertexIndex> vertices) {
  clustering_.leaf_.resize(network_.end(), kNoCluster);
  for (const VertexIndex v : vertices) {
    ClusterIndex& leaf = clustering_.leaf_[v];
    const bool gone = network_.landmark_of(v) == 0;
    if (leaf != kNoCluster) waiting_.insert(leaf);
    if (gone && leaf != kNoCluster) {
      touched_.insert(leaf);
      std::erase(clustering_.nodes_[leaf].members, v);
      leaf = kNoCluster;
    } else if (!gone && leaf == kNoCluster) {
      ClusterIndex above = kNoCluster;
      for (int level = clustering_.levels_; level >= 1; --level) {
        above = clustering_.add(level, above);
        touched_.insert(above);
      }
      clustering_.adopt(above, std::span(&v, 1));
      waiting_.insert(above);
    }
  }
}

void ClusterUpkeep::tend_levels() {
  for (level_ = 1; level_ <= clustering_.levels_; ++level_) {
    while (!waiting_.empty()) {
      const ClusterIndex cluster = *waiting_.begin();
      waiting_.erase(waiting_.begin());
      tend(cluster);
    }
    for (const ClusterIndex cluster : seen_) {
      ClusterNode& node = clustering_.nodes_[cluster];
      if (node.level != level_) continue;
      const std::vector<VertexIndex> before = node.boundary;
      clustering_.find_boundary(network_, cluster);
      clustering_.find_anchor(network_, cluster);
      if (node.boundary != before) touched_.insert(cluster);
      if (node.parent != kNoCluster) next_.insert(node.parent);
    }
    seen_.clear();
    waiting_ = std::move(next_);
    next_.clear();
  }
}

void ClusterUpkeep::tend(ClusterIndex cluster) {
  ClusterNode& node = clustering_.nodes_[cluster];
  if (node.level != level_) return;  // merged into another one meanwhile
  if (node.members.empty()) {
    remove(cluster);
    return;
  }
  seen_.insert(cluster);
  clustering_.adopt(cluster, std::vector(node.members));  // counts landmarks anew
  divide(cluster);
}

void ClusterUpkeep::divide(ClusterIndex cluster) {
  const std::vector<std::uint32_t> members = clustering_.nodes_[cluster].members;
  const std::int32_t most = clustering_.sizes_.most(level_);
  const GroupingGraph graph = builder_.graph_of(members, level_);
  const auto group_of = connected_groups(graph, most, propose_);
  const auto groups = static_cast<std::size_t>(*std::max_element(group_of.begin(), group_of.end())) + 1;
  if (groups > 1) {
    std::vector<std::vector<std::uint32_t>> parts(groups);
    std::vector<std::int64_t> sizes(groups);
    for (std::size_t i = 0; i < members.size(); ++i) {
      parts[static_cast<std::size_t>(group_of[i])].push_back(members[i]);
      sizes[static_cast<std::size_t>(group_of[i])] += graph.size[i];
    }
    // The part with the anchor keeps id and name, else the largest.
    auto kept = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    const VertexIndex anchor = network_.vertex_of(clustering_.nodes_[cluster].anchor);
    const std::uint32_t holder = anchor == kNoVertex ? kNoCluster
                                 : level_ == 1       ? anchor
                                                     : clustering_.cluster_of(anchor, level_ - 1);
    if (const auto at = std::lower_bound(members.begin(), members.end(), holder); at != members.end() && *at == holder)
      kept = static_cast<std::size_t>(group_of[static_cast<std::size_t>(at - members.begin())]);
    touch(cluster);
    clustering_.adopt(cluster, parts[kept]);
    std::vector<ClusterIndex> split_off;
    for (std::size_t part = 0; part < groups; ++part) {
      if (part == kept) continue;
      const ClusterIndex fresh = split_off.emplace_back(clustering_.add(level_, clustering_.nodes_[cluster].parent));
      clustering_.adopt(fresh, parts[part]);
      touch(fresh);
      pushed_.insert(fresh);
    }
    // Only now that each member is where it belongs.
    for (const ClusterIndex fresh : split_off) merge_if_small(fresh);
  }
  merge_if_small(cluster);
}

// A cluster below a quarter of what is allowed joins the neighbour that most ties bind it to and that has room. When
// none has, it pushes into one all the same, once, and the two are divided anew. Of two clusters one of which the user
// has named that one stays; two such are never merged.
void ClusterUpkeep::merge_if_small(ClusterIndex cluster) {
  const std::int32_t most = clustering_.sizes_.most(level_);
  const std::int32_t landmarks = clustering_.nodes_[cluster].landmarks;
  if (clustering_.nodes_[cluster].level != level_ || 4 * std::int64_t{landmarks} >= most) return;
  if (as_saved_.contains(cluster)) return;
  const auto is_named = [&](ClusterIndex one) { return !clustering_.nodes_[one].name.empty(); };
  auto ties = builder_.ties_of(cluster);
  std::erase_if(ties, [&](const auto& tie) { return is_named(cluster) && is_named(tie.first); });
  const auto fits = [&](ClusterIndex other) { return clustering_.nodes_[other].landmarks + landmarks <= most; };
  const bool push = std::none_of(ties.begin(), ties.end(), [&](const auto& tie) { return fits(tie.first); });
  if (ties.empty() || (push && !pushed_.insert(cluster).second)) return;
  auto best = ties.end();
  for (auto tie = ties.begin(); tie != ties.end(); ++tie)
    if ((push || fits(tie->first)) && (best == ties.end() || tie->second > best->second)) best = tie;
  ClusterIndex into = best->first;
  ClusterIndex from = cluster;
  if (is_named(from) != is_named(into) ? is_named(from) : clustering_.nodes_[into].landmarks < landmarks)
    std::swap(into, from);
  if (push) pushed_.insert(into);
  std::vector<std::uint32_t> members = clustering_.nodes_[into].members;
  const std::vector<std::uint32_t> more = clustering_.nodes_[from].members;
  members.insert(members.end(), more.begin(), more.end());
  remove(from);
  clustering_.adopt(into, members);
  touch(into);
  waiting_.insert(into);
}

void ClusterUpkeep::change_levels() {
  const std::size_t landmarks = network_.landmarks();
  const auto levels_for = [&](std::size_t n) {
    return std::min(clustering_.sizes_.levels_for(n), clustering_.max_levels_);
  };
  // Not to and fro with every landmark that comes and goes.
  while (levels_for(landmarks - landmarks / 5) > clustering_.levels_) {
    builder_.add_top_level();
    levels_changed_ = true;
  }
  while (levels_for(landmarks + landmarks / 4) < clustering_.levels_) {
    const int max_levels = clustering_.max_levels_;
    clustering_.drop_level();
    clustering_.max_levels_ = max_levels;
    levels_changed_ = true;
  }
}

Clustering::Upkeep ClusterUpkeep::follow(std::span<const VertexIndex> vertices) {
  if (clustering_.levels_ == 0) {
    clustering_.leaf_.resize(network_.end(), kNoCluster);
    builder_.build();
    return {{}, clustering_.levels_ > 0};
  }
  place(vertices);
  tend_levels();
  change_levels();
  return {{touched_.begin(), touched_.end()}, levels_changed_};
}

// The clusters of one chain, as far as they are not made yet, under each other; gives the lowest.
ClusterIndex ClusterUpkeep::make_chain(const std::vector<const Cluster*>& chain,
                                       std::map<const Cluster*, ClusterIndex>& made) {
  ClusterIndex above = kNoCluster;
  for (auto cluster = chain.rbegin(); cluster != chain.rend(); ++cluster) {
    const auto [at, fresh] = made.emplace(*cluster, kNoCluster);
    if (fresh) {
      at->second = clustering_.add((*cluster)->level, above);
      ClusterNode& node = clustering_.nodes_[at->second];
      node.id = (*cluster)->id;
      node.anchor = (*cluster)->anchor;
      node.name = (*cluster)->name;
    }
    above = at->second;
  }
  return above;
}

// Members of the clusters that chains have made, from level 1 up.
void ClusterUpkeep::fill_as_saved(const std::map<ClusterIndex, std::vector<VertexIndex>>& vertices) {
  for (const auto& [leaf, members] : vertices) clustering_.adopt(leaf, members);
  for (int level = 1; level <= clustering_.levels_; ++level)
    for (const ClusterIndex cluster : clustering_.of_level(level)) {
      if (level > 1) clustering_.adopt(cluster, std::vector(clustering_.nodes_[cluster].members));
      as_saved_.insert(cluster);
      if (level == 1) waiting_.insert(cluster);
    }
}

void ClusterUpkeep::restore(const ClusterTree& saved) {
  std::map<VertexIndex, std::vector<const Cluster*>> chains;
  std::size_t levels = 0;
  for (const auto& [landmark, leaf] : saved.cluster_of)
    if (const VertexIndex v = network_.vertex_of(landmark); v != kNoVertex) {
      std::vector<const Cluster*> chain = chain_of(saved, leaf);
      levels = std::max(levels, chain.size());
      chains.emplace(v, std::move(chain));
    }
  ClusterId next_id = std::clamp<ClusterId>(saved.next_id, 1, kMaxSavedId);
  clustering_.next_id_ = next_id;
  if (levels == 0) return builder_.build();
  clustering_.levels_ = static_cast<int>(levels);
  std::map<const Cluster*, ClusterIndex> made;
  std::map<ClusterIndex, std::vector<VertexIndex>> vertices;
  for (const auto& [v, chain] : chains)
    if (chain.size() == levels) vertices[make_chain(chain, made)].push_back(v);
  for (const auto& [cluster, index] : made) next_id = std::max(next_id, cluster->id + 1);
  clustering_.next_id_ = next_id;
  fill_as_saved(vertices);
  std::vector<VertexIndex> all;
  for (VertexIndex v = 0; v < network_.end(); ++v)
    if (network_.landmark_of(v) != 0) all.push_back(v);
  place(all);
  tend_levels();
  change_levels();
}

}  // namespace cairn
