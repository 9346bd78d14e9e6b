#include "planners/landmark_search/graphs/query_graph.hpp"

#include <algorithm>
#include <tuple>

namespace cairn {

QueryGraph::QueryGraph(const Hierarchy& hierarchy, const RouteQuery& query, const OpenClusters& clusters)
    : hierarchy_(hierarchy),
      query_(query),
      clusters_(clusters),
      goals_(query.to),
      is_plain_(query.avoided.empty() && query.costs.empty()) {
  std::ranges::sort(goals_, [](const SearchEnd& a, const SearchEnd& b) {
    return std::pair(a.vertex, a.cost) < std::pair(b.vertex, b.cost);
  });
}

std::pair<const SearchEnd*, const SearchEnd*> QueryGraph::goals_at(VertexIndex v) const {
  const auto first = std::ranges::lower_bound(goals_, v, {}, &SearchEnd::vertex);
  const auto last = std::ranges::upper_bound(goals_, v, {}, &SearchEnd::vertex);
  return {goals_.data() + (first - goals_.begin()), goals_.data() + (last - goals_.begin())};
}

GraphEdge QueryGraph::as_asked(GraphEdge edge) const {
  if (edge.route != 0)
    if (const auto found = query_.costs.find(edge.route); found != query_.costs.end()) edge.cost = found->second;
  if (!query_.avoided.contains(edge.to)) return edge;
  const auto [first, last] = goals_at(edge.to);
  edge.cost = first == last ? kNoRoute : edge.cost + first->cost;
  edge.to = goal();
  return edge;
}

std::pair<QueryGraph::EdgeIterator, QueryGraph::EdgeIterator> QueryGraph::edges_of(VertexIndex v) const {
  EdgeIterator first;
  first.graph_ = this;
  first.vertex_ = v;
  if (v == start()) {
    first.end_ = query_.from.data();
    first.ends_end_ = first.end_ + query_.from.size();
  } else if (v != goal()) {
    std::tie(first.end_, first.ends_end_) = goals_at(v);
    first.at_ = LevelEdges::first_of(hierarchy_, v, clusters_.whole_around(v), Routes::all);
  }
  first.find_edge();
  return {first, EdgeIterator()};
}

}  // namespace cairn
