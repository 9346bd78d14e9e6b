// Which clusters a search has to look into for a query: those that hold an end, an avoided landmark, or both ends of a
// route that costs something else. It passes every other cluster by its kept costs.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/landmark_search/graph_search.hpp"

namespace cairn {

// Used again for query after query: each opens its own clusters and no more.
class OpenClusters {
 public:
  void begin(const Hierarchy& hierarchy, const RouteQuery& query);

  // The largest cluster around a vertex that is passed as a whole; kNoCluster: the vertex is looked at itself.
  [[nodiscard]] ClusterIndex whole_around(VertexIndex v) const {
    ClusterIndex whole = kNoCluster;
    for (ClusterIndex c = hierarchy_->clustering().leaf_of(v); c != kNoCluster && opened_[c] != query_number_;
         c = hierarchy_->overlay().parent_of(c))
      whole = c;
    return whole;
  }

 private:
  void open_around(VertexIndex v);
  void open_with(RouteId route);

  const Hierarchy* hierarchy_ = nullptr;
  std::vector<std::uint32_t> opened_;  // by cluster: the query in which it is looked into
  std::uint32_t query_number_ = 0;
};

}  // namespace cairn
