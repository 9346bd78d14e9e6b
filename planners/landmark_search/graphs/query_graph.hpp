// One query as a model of Boost.Graph's IncidenceGraph: around its ends the landmark graph, elsewhere the highest level
// of the overlay whose cluster holds nothing of the query. A view: nothing is copied.
//
// Two more vertices make one start and one goal of any number: start() leads to each start at what that costs, and each
// goal leads to goal(). An avoided landmark is entered by no edge but from start(); what would enter it as a goal leads
// to goal() instead.
#pragma once

#include <utility>
#include <vector>

#include "planners/landmark_search/graphs/level_graph.hpp"
#include "planners/landmark_search/open_clusters.hpp"

namespace cairn {

class QueryGraph {
 public:
  class EdgeIterator;
  using vertex_descriptor = VertexIndex;
  using edge_descriptor = GraphEdge;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::allow_parallel_edge_tag;
  using traversal_category = boost::incidence_graph_tag;
  using degree_size_type = std::size_t;
  using out_edge_iterator = EdgeIterator;
  static vertex_descriptor null_vertex() { return kNoVertex; }

  // All three must outlive it; the clusters are those that are open for the query.
  QueryGraph(const Hierarchy& hierarchy, const RouteQuery& query, const OpenClusters& clusters);

  [[nodiscard]] VertexIndex start() const { return hierarchy_.network().end(); }
  [[nodiscard]] VertexIndex goal() const { return start() + 1; }
  [[nodiscard]] VertexIndex end() const { return start() + 2; }  // above all numbers
  [[nodiscard]] const std::vector<SearchEnd>& goals() const { return goals_; }
  // The highest level on which a vertex is searched; not of start() and goal().
  [[nodiscard]] int level_of(VertexIndex v) const {
    const ClusterIndex whole = clusters_.whole_around(v);
    return whole == kNoCluster ? 0 : hierarchy_.clustering().node(whole).level;
  }

  [[nodiscard]] std::pair<EdgeIterator, EdgeIterator> edges_of(VertexIndex v) const;

 private:
  using LevelEdges = LevelEdgeIterator<Direction::out>;

  [[nodiscard]] std::pair<const SearchEnd*, const SearchEnd*> goals_at(VertexIndex v) const;
  [[nodiscard]] GraphEdge as_asked(GraphEdge edge) const;  // its cost is kNoRoute when it is not to be taken

  const Hierarchy& hierarchy_;
  const RouteQuery& query_;
  const OpenClusters& clusters_;
  std::vector<SearchEnd> goals_;  // by rising vertex, then cost
  bool is_plain_;                 // edges are those of the levels
};

// First the edges from start() or to goal(), then those of the level.
class QueryGraph::EdgeIterator : public boost::iterator_facade<QueryGraph::EdgeIterator, const GraphEdge,
                                                               boost::forward_traversal_tag, const GraphEdge&> {
 public:
  EdgeIterator() = default;

 private:
  friend class boost::iterator_core_access;
  friend class QueryGraph;

  void find_edge() {
    if (end_ != ends_end_) {
      edge_ = vertex_ == graph_->start() ? GraphEdge{vertex_, end_->vertex, 0, end_->cost}
                                         : GraphEdge{vertex_, graph_->goal(), 0, end_->cost};
      return;
    }
    for (; !at_.is_at_end(); ++at_) {
      edge_ = graph_->is_plain_ ? *at_ : graph_->as_asked(*at_);
      if (edge_.cost < kNoRoute) return;
    }
  }
  void increment() {
    if (end_ != ends_end_)
      ++end_;
    else
      ++at_;
    find_edge();
  }
  [[nodiscard]] bool is_at_end() const { return end_ == ends_end_ && at_.is_at_end(); }
  // Of iterators of the same vertex; an end is a default one.
  [[nodiscard]] bool equal(const EdgeIterator& other) const {
    if (graph_ == nullptr || other.graph_ == nullptr) return is_at_end() == other.is_at_end();
    return end_ == other.end_ && at_ == other.at_;
  }
  [[nodiscard]] const GraphEdge& dereference() const { return edge_; }

  const QueryGraph* graph_ = nullptr;
  VertexIndex vertex_ = kNoVertex;
  const SearchEnd* end_ = nullptr;
  const SearchEnd* ends_end_ = nullptr;
  LevelEdges at_;
  GraphEdge edge_;
};

inline VertexIndex source(const GraphEdge& edge, const QueryGraph&) {
  return edge.from;
}
inline VertexIndex target(const GraphEdge& edge, const QueryGraph&) {
  return edge.to;
}
inline std::pair<QueryGraph::EdgeIterator, QueryGraph::EdgeIterator> out_edges(VertexIndex v, const QueryGraph& graph) {
  return graph.edges_of(v);
}
inline std::size_t out_degree(VertexIndex v, const QueryGraph& graph) {
  const auto [first, last] = graph.edges_of(v);
  return static_cast<std::size_t>(std::distance(first, last));
}
inline EdgeCost get(boost::edge_weight_t, const QueryGraph&) {
  return {};
}

}  // namespace cairn
