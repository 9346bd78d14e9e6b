#include "planners/landmark_search/graphs/level_graph.hpp"

#include <algorithm>

namespace cairn {

LevelGraph::LevelGraph(const Hierarchy& hierarchy, int level) : hierarchy_(&hierarchy), level_(level) {
  std::vector<VertexIndex> vertices;
  const Network& network = hierarchy.network();
  for (VertexIndex v = 0; v < network.end(); ++v)
    if (network.landmark_of(v) != 0 &&
        (level == 0 || std::ranges::binary_search(hierarchy.clustering().node(cluster_of(v)).boundary, v)))
      vertices.push_back(v);
  vertices_ = std::make_shared<const std::vector<VertexIndex>>(std::move(vertices));
}

}  // namespace cairn
