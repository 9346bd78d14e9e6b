#include "planners/landmark_search/explain.hpp"

#include <algorithm>

namespace cairn {
namespace {

std::vector<std::vector<ClusterId>> clusters_along(const GraphPath& path, const Clustering& clustering) {
  std::vector<std::vector<ClusterId>> clusters(static_cast<std::size_t>(clustering.levels()));
  for (const VertexIndex v : path.vertices)
    for (int level = 1; level <= clustering.levels(); ++level) {
      auto& passed = clusters[static_cast<std::size_t>(level - 1)];
      const ClusterId id = clustering.node(clustering.cluster_of(v, level)).id;
      if (passed.empty() || passed.back() != id) passed.push_back(id);
    }
  return clusters;
}

}  // namespace

RouteExplanation explanation_of(const GraphPath& path, const RouteQuery& query, const RouteRequest& request,
                                const LandmarkGraph& graph, const Hierarchy& hierarchy, const RouteCost& cost,
                                GraphSearch& search, const Budget& budget) {
  RouteExplanation explanation;
  explanation.settled_of_level = path.settled_of_level;
  explanation.clusters = clusters_along(path, hierarchy.clustering());
  if (path.cost < kNoRoute) explanation.cost = path.cost;
  RouteQuery open = query;
  open.costs.clear();  // which held what the request closes
  for (const RouteId id : request.closed)
    if (const Route* const route = graph.find_route(id)) open.costs[id] = cost(*route);
  for (const auto& [id, route] : graph.routes())
    if (route.closed) open.costs[id] = cost(route);
  if (open.costs.empty()) return explanation;
  const GraphPath better = search.find(hierarchy, open, budget);
  if (better.stopped || !(better.cost < path.cost)) return explanation;
  explanation.cost_with_closed_open = better.cost;
  for (const RouteId id : better.routes)
    if (open.costs.contains(id)) explanation.closed_on_cheaper_path.push_back(id);
  return explanation;
}

}  // namespace cairn
