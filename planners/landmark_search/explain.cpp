#include "planners/landmark_search/explain.hpp"

#include <algorithm>

namespace cairn {
namespace {

std::vector<std::vector<ClusterId>> clusters_along(const Way& way, const Clustering& clustering) {
  std::vector<std::vector<ClusterId>> clusters(static_cast<std::size_t>(clustering.levels()));
  for (const VertexIndex v : way.vertices)
    for (int level = 1; level <= clustering.levels(); ++level) {
      auto& passed = clusters[static_cast<std::size_t>(level - 1)];
      const ClusterId id = clustering.node(clustering.cluster_of(v, level)).id;
      if (passed.empty() || passed.back() != id) passed.push_back(id);
    }
  return clusters;
}

}  // namespace

PlanExplanation explanation_of(const Way& way, const RouteQuery& query, const PlanRequest& request,
                               const LandmarkGraph& graph, const Hierarchy& hierarchy, const RouteCost& cost,
                               HierarchySearch& search, const Budget& budget) {
  PlanExplanation explanation;
  explanation.settled_of_level = way.settled_of_level;
  explanation.clusters = clusters_along(way, hierarchy.clustering());
  if (way.cost < kNoWay) explanation.cost = way.cost;
  RouteQuery open = query;
  open.costs.clear();  // which held what the request closes
  for (const RouteId id : request.closed)
    if (const Route* const route = graph.find_route(id)) open.costs[id] = cost(*route);
  for (const auto& [id, route] : graph.routes())
    if (route.closed) open.costs[id] = cost(route);
  if (open.costs.empty()) return explanation;
  const Way better = search.find(hierarchy, open, budget);
  if (better.stopped || !(better.cost < way.cost)) return explanation;
  explanation.cost_with_closed_open = better.cost;
  for (const RouteId id : better.routes)
    if (open.costs.contains(id)) explanation.closed_in_the_way.push_back(id);
  return explanation;
}

}  // namespace cairn
