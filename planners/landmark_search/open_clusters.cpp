#include "planners/landmark_search/open_clusters.hpp"

#include <algorithm>

namespace cairn {

void OpenClusters::begin(const Hierarchy& hierarchy, const RouteQuery& query) {
  hierarchy_ = &hierarchy;
  opened_.resize(hierarchy.clustering().end(), 0);
  if (++query_number_ == 0) {
    std::fill(opened_.begin(), opened_.end(), 0);
    query_number_ = 1;
  }
  for (const auto* ends : {&query.from, &query.to})
    for (const SearchEnd& end : *ends) open_around(end.vertex);
  for (const VertexIndex v : query.avoided) open_around(v);
  for (const auto& [route, cost] : query.costs) open_with(route);
}

void OpenClusters::open_around(VertexIndex v) {
  for (ClusterIndex c = hierarchy_->clustering().leaf_of(v); c != kNoCluster && opened_[c] != query_number_;
       c = hierarchy_->overlay().parent_of(c))
    opened_[c] = query_number_;
}

// Those that hold both ends of the route; others know it as an arc that leaves them.
void OpenClusters::open_with(RouteId route) {
  const Clustering& clustering = hierarchy_->clustering();
  const auto [from, to] = hierarchy_->network().ends_of(route);
  if (from == kNoVertex) return;
  ClusterIndex a = clustering.leaf_of(from);
  for (ClusterIndex b = clustering.leaf_of(to); a != b; b = clustering.node(b).parent) a = clustering.node(a).parent;
  for (; a != kNoCluster; a = clustering.node(a).parent) opened_[a] = query_number_;
}

}  // namespace cairn
