#include "planners/landmark_search/boost_landmark_graph.hpp"

#include <algorithm>
#include <utility>

namespace cairn {

BoostLandmarkGraph::BoostLandmarkGraph(const LandmarkGraph& landmarks) {
  ids.reserve(landmarks.landmarks().size());
  for (const auto& [id, landmark] : landmarks.landmarks()) ids.push_back(id);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  std::vector<RouteEdge> edges;
  ends.reserve(landmarks.routes().size());
  edges.reserve(landmarks.routes().size());
  for (const auto& [id, route] : landmarks.routes()) {
    if (route.closed) continue;
    ends.emplace_back(vertex_of(route.from), vertex_of(route.to));
    edges.push_back({route.cost_m, &route});
  }
  graph = Graph(boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), edges.begin(), ids.size());
}

std::size_t BoostLandmarkGraph::vertex_of(LandmarkId id) const {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  return at != ids.end() && *at == id ? static_cast<std::size_t>(at - ids.begin()) : kNone;
}

}  // namespace cairn
