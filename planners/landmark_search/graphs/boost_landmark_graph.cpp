#include "planners/landmark_search/graphs/boost_landmark_graph.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cairn {

BoostLandmarkGraph::BoostLandmarkGraph(const LandmarkGraph& landmarks, const RouteRequest& request) {
  const std::set<RouteId> closed(request.closed.begin(), request.closed.end());
  const std::set<LandmarkId> avoided(request.avoid.begin(), request.avoid.end());
  const auto in = [](const std::vector<RouteEnd>& ends_of_request, LandmarkId id) {
    return std::ranges::find(ends_of_request, id, &RouteEnd::landmark) != ends_of_request.end();
  };
  // Into an avoided landmark only as the goal, out of it only as the start.
  const auto is_shut = [&](const Route& route) {
    return route.closed || closed.contains(route.id) || (avoided.contains(route.to) && !in(request.to, route.to)) ||
           (avoided.contains(route.from) && !in(request.from, route.from));
  };
  ids.reserve(landmarks.landmarks().size());
  for (const auto& [id, landmark] : landmarks.landmarks()) ids.push_back(id);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  std::vector<RouteEdge> edges;
  ends.reserve(landmarks.routes().size());
  edges.reserve(landmarks.routes().size());
  for (const auto& [id, route] : landmarks.routes()) {
    if (is_shut(route)) continue;
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
