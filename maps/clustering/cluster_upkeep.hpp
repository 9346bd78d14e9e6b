// Keeps clusters connected and of bounded size while their network changes. Private to the hierarchy.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "maps/clustering/cluster_builder.hpp"

namespace cairn {

class ClusterUpkeep {
 public:
  ClusterUpkeep(Clustering& clustering, const Network& network)
      : clustering_(clustering), network_(network), builder_(clustering, network, propose_) {}

  Clustering::Upkeep follow(std::span<const VertexIndex> vertices);
  // Into a clustering without levels.
  void restore(const ClusterTree& saved);

 private:
  ClusterIndex make_chain(const std::vector<const Cluster*>& chain, std::map<const Cluster*, ClusterIndex>& made);
  void fill_as_saved(const std::map<ClusterIndex, std::vector<VertexIndex>>& vertices);
  void place(std::span<const VertexIndex> vertices);
  void tend_levels();
  void tend(ClusterIndex cluster);
  void divide(ClusterIndex cluster);
  void merge_if_small(ClusterIndex cluster);
  void touch(ClusterIndex cluster);
  void remove(ClusterIndex cluster);
  void change_levels();

  const Proposal propose_ = propose_by_metis;
  Clustering& clustering_;
  const Network& network_;
  ClusterBuilder builder_;
  int level_ = 1;
  std::set<ClusterIndex> waiting_;   // of level_, to be tended
  std::set<ClusterIndex> next_;      // of the level above
  std::set<ClusterIndex> seen_;      // of level_, tended or changed: look at their boundary again
  std::set<ClusterIndex> pushed_;    // have been merged into a full neighbour once
  std::set<ClusterIndex> as_saved_;  // restored: small ones stay as they are
  std::set<ClusterIndex> touched_;
  bool levels_changed_ = false;
};

}  // namespace cairn
