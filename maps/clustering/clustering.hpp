// The clusters of a network, level on level, kept connected and of bounded size while the network changes
// (docs/method.md 9.2).
//
// Level 1 clusters hold vertices, clusters of level l + 1 hold clusters of level l. A vertex is in one cluster of
// every level. A few vertices have no levels. A small network has one level, formed anew with every change: its
// clusters are joined by narrow passages. A large one is clustered for searches. Clusters keep their id, anchor and
// name through changes; what is split off gets new ones.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "maps/clustering/cluster_tree.hpp"
#include "maps/clustering/grouping.hpp"
#include "maps/clustering/network.hpp"

namespace cairn {

using ClusterIndex = std::uint32_t;
inline constexpr ClusterIndex kNoCluster = std::numeric_limits<ClusterIndex>::max();

struct ClusterSizes {
  std::int32_t leaf = 32;        // landmarks of a level 1 cluster, at most
  std::int32_t growth = 4;       // a cluster one level up may hold this many times as many
  std::size_t large_from = 300;  // landmarks; smaller networks have one level, divided where passages are narrow
  std::size_t from = 8;          // landmarks; fewer have no clusters
  double narrow_below_m = 1.3;   // passages of routes that divide the clusters of a small network
  [[nodiscard]] std::int32_t most(int level) const;  // landmarks of a cluster of that level
  // In a small network where no passage is known: 2 sqrt(landmarks), as many clusters as landmarks in each or half of
  // it, and no more than `leaf`.
  [[nodiscard]] std::int32_t most_by_length(std::size_t landmarks) const;
  [[nodiscard]] int levels_for(std::size_t landmarks) const;
  bool operator==(const ClusterSizes&) const = default;
};
// No clusters at all.
[[nodiscard]] constexpr ClusterSizes no_clusters() {
  return {.large_from = SIZE_MAX, .from = SIZE_MAX};
}

// The width of the narrowest place of a route, m (passage_width.hpp); none: it is not known.
using PassageWidths = std::function<std::optional<double>(RouteId)>;

struct ClusterNode {
  int level = 0;  // 0: the index is free
  ClusterIndex parent = kNoCluster;
  std::vector<std::uint32_t> members;  // vertices on level 1, indices of clusters above
  std::vector<VertexIndex> boundary;   // vertices with a route, open or closed, out of or into the cluster; rising
  std::int32_t landmarks = 0;
  ClusterId id = 0;
  LandmarkId anchor = 0;
  std::string name;
};

class Clustering {
 public:
  Clustering(const Network& network, const ClusterSizes& sizes, const Proposal& propose = propose_by_metis,
             const PassageWidths& widths = {});
  // As saved. What does not fit the network (any more) is mended: landmarks without a cluster get one, clusters in
  // pieces are split. An empty tree: clustered anew.
  Clustering(const Network& network, const ClusterSizes& sizes, const ClusterTree& saved,
             const PassageWidths& widths = {});

  // What a change of the network did to the clusters.
  struct Upkeep {
    std::vector<ClusterIndex> touched;  // have other members or another boundary, or are new or gone
    bool levels_changed = false;        // one was put on top or taken away
  };
  // Brings the clusters in line after the network has got or lost vertices or arcs. `vertices`: those that are
  // new or gone, and both ends of each such arc.
  Upkeep follow(const Network& network, std::span<const VertexIndex> vertices, const PassageWidths& widths = {});
  // Takes the highest level away.
  void drop_level();

  [[nodiscard]] int levels() const { return levels_; }
  [[nodiscard]] bool is_small() const { return is_small_; }
  [[nodiscard]] ClusterIndex end() const { return static_cast<ClusterIndex>(nodes_.size()); }
  [[nodiscard]] const ClusterNode& node(ClusterIndex cluster) const { return nodes_[cluster]; }
  // Of level 1; kNoCluster when there are no levels.
  [[nodiscard]] ClusterIndex leaf_of(VertexIndex v) const { return v < leaf_.size() ? leaf_[v] : kNoCluster; }
  [[nodiscard]] ClusterIndex cluster_of(VertexIndex v, int level) const;
  [[nodiscard]] std::vector<ClusterIndex> of_level(int level) const;
  [[nodiscard]] const ClusterSizes& sizes() const { return sizes_; }

  [[nodiscard]] ClusterTree tree(const Network& network) const;
  void set_name(ClusterIndex cluster, std::string name) { nodes_[cluster].name = std::move(name); }

 private:
  friend class ClusterBuilder;
  friend class ClusterFormer;
  friend class ClusterUpkeep;

  ClusterIndex add(int level, ClusterIndex parent);
  void remove(ClusterIndex cluster);
  // Makes vertices, or clusters of the level below, members; they leave no other cluster by this.
  void adopt(ClusterIndex cluster, std::span<const std::uint32_t> members);
  void find_boundary(const Network& network, ClusterIndex cluster);
  void find_anchor(const Network& network, ClusterIndex cluster);  // keeps one that is still a member
  void clear();

  ClusterSizes sizes_;
  int levels_ = 0;
  bool is_small_ = false;
  std::vector<ClusterNode> nodes_;
  std::vector<ClusterIndex> free_;
  std::vector<ClusterIndex> leaf_;  // of each vertex
  double usual_cost_ = 0.0;         // of a route, when the clusters were made
  // Levels above were not worth keeping once (drop_level()); they are not tried again.
  int max_levels_ = std::numeric_limits<int>::max();
  ClusterId next_id_ = 1;
};

}  // namespace cairn
