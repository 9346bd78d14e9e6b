// Makes the clusters of a network, from the highest level down. Private to the hierarchy.
#pragma once

#include <limits>
#include <map>

#include "maps/clustering/clustering.hpp"

namespace cairn {

// Of a saved cluster; more are to follow.
inline constexpr ClusterId kMaxSavedId = std::numeric_limits<ClusterId>::max() / 2;

class ClusterBuilder {
 public:
  ClusterBuilder(Clustering& clustering, const Network& network, const Proposal& propose)
      : clustering_(clustering), network_(network), propose_(propose) {}

  void build();
  // What a route usually costs, for the weights of ties.
  void measure_costs();
  // One more level over the present highest one.
  void add_top_level();
  // Members of a cluster, or of a would-be one, with the ties between them.
  [[nodiscard]] GroupingGraph graph_of(std::span<const std::uint32_t> members, int level);
  // The clusters beside one of the same level, and how strongly they are tied to it.
  [[nodiscard]] std::map<ClusterIndex, std::int64_t> ties_of(ClusterIndex cluster) const;

 private:
  void divide(std::span<const VertexIndex> vertices, int level, ClusterIndex parent);
  [[nodiscard]] std::int32_t weight_of(const Arc& arc) const;
  template <class Visit>
  void for_each_tie(std::uint32_t member, int level, Visit visit) const;

  Clustering& clustering_;
  const Network& network_;
  const Proposal& propose_;
  std::vector<std::int32_t> local_;  // vertex or cluster -> node of a grouping graph; -1
};

}  // namespace cairn
