// The landmark graph and the levels of its overlay as models of Boost.Graph's concepts: PropertyGraph (edge_weight,
// vertex_index), VertexListGraph and BidirectionalGraph. Views: edges and costs are those of the hierarchy.
#pragma once

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {

struct GraphEdge {
  VertexIndex from = kNoVertex;
  VertexIndex to = kNoVertex;
  RouteId route = 0;  // 0: through a cluster, by its kept cost
  double cost = 0.0;
  bool operator==(const GraphEdge&) const = default;
};

// Which routes an iterator passes over.
enum class Routes : std::uint8_t { open, all };
// Whether edges leave the vertex or enter it.
enum class Direction : std::uint8_t { out, in };

// Over the routes of a vertex, and the ways through its cluster to the other boundary vertices.
template <Direction kDirection>
class LevelEdgeIterator
    : public boost::iterator_facade<LevelEdgeIterator<kDirection>, GraphEdge, boost::forward_traversal_tag, GraphEdge> {
 public:
  // First edge and end of a vertex: of the network (no cluster), or of the level of a cluster that it bounds.
  static std::pair<LevelEdgeIterator, LevelEdgeIterator> range(const Hierarchy& hierarchy, VertexIndex v,
                                                               ClusterIndex cluster, Routes routes) {
    const LevelEdgeIterator first = first_of(hierarchy, v, cluster, routes);
    LevelEdgeIterator last = first;
    last.arc_ = first.arcs_end_;
    last.other_ = first.others_;
    return {first, last};
  }
  static LevelEdgeIterator first_of(const Hierarchy& hierarchy, VertexIndex v, ClusterIndex cluster, Routes routes) {
    LevelEdgeIterator first;
    first.vertex_ = v;
    first.routes_ = routes;
    if (cluster == kNoCluster) {
      const auto& arcs = kDirection == Direction::out ? hierarchy.network().out(v) : hierarchy.network().in(v);
      first.arc_ = arcs.data();
      first.arcs_end_ = arcs.data() + arcs.size();
    } else {
      first.begin_in(hierarchy.overlay().passage(cluster), hierarchy.clustering().node(cluster).boundary);
    }
    first.skip();
    return first;
  }
  [[nodiscard]] bool is_at_end() const { return arc_ == arcs_end_ && other_ == others_; }

 private:
  friend class boost::iterator_core_access;

  void begin_in(const Passage& passage, const std::vector<VertexIndex>& boundary) {
    constexpr bool kOut = kDirection == Direction::out;
    const std::vector<Arc>& arcs = kOut ? passage.out : passage.in;
    const std::vector<std::uint32_t>& begin = kOut ? passage.out_begin : passage.in_begin;
    index_ = position_of(boundary, vertex_);
    arc_ = arcs.data() + begin[index_];
    arcs_end_ = arcs.data() + begin[index_ + 1];
    others_ = static_cast<std::uint32_t>(boundary.size());
    boundary_ = boundary.data();
    through_ = (kOut ? passage.through : passage.through_back).data() + std::size_t{index_} * others_;
  }
  // To what is an edge.
  void skip() {
    if (routes_ == Routes::open)
      while (arc_ != arcs_end_ && !(arc_->cost < kNoRoute)) ++arc_;
    if (arc_ == arcs_end_)
      while (other_ != others_ && (other_ == index_ || !(through_[other_] < kNoRoute))) ++other_;
  }
  void increment() {
    if (arc_ != arcs_end_)
      ++arc_;
    else
      ++other_;
    skip();
  }
  [[nodiscard]] bool equal(const LevelEdgeIterator& other) const {
    return arc_ == other.arc_ && other_ == other.other_;
  }
  [[nodiscard]] GraphEdge dereference() const {
    const bool is_route = arc_ != arcs_end_;
    const VertexIndex other = is_route ? arc_->other : boundary_[other_];
    GraphEdge edge{vertex_, other, is_route ? arc_->route : 0, is_route ? arc_->cost : through_[other_]};
    if constexpr (kDirection == Direction::in) std::swap(edge.from, edge.to);
    return edge;
  }

  VertexIndex vertex_ = kNoVertex;
  Routes routes_ = Routes::open;
  const Arc* arc_ = nullptr;  // then, past the last one, the boundary vertices from other_ on
  const Arc* arcs_end_ = nullptr;
  const double* through_ = nullptr;
  const VertexIndex* boundary_ = nullptr;
  std::uint32_t index_ = 0;  // of the vertex in the boundary
  std::uint32_t other_ = 0;
  std::uint32_t others_ = 0;
};

// Level 0: landmarks and open routes. Level l: the boundary vertices of the clusters of level l, the open routes from
// cluster to cluster, and the kept costs of the ways through each cluster. Made in O(n), copied in O(1). Good until the
// hierarchy is updated.
class LevelGraph {
 public:
  using vertex_descriptor = VertexIndex;  // of the network
  using edge_descriptor = GraphEdge;
  using directed_category = boost::bidirectional_tag;
  using edge_parallel_category = boost::allow_parallel_edge_tag;
  struct traversal_category : boost::bidirectional_graph_tag, boost::vertex_list_graph_tag {};
  using vertices_size_type = std::size_t;
  using degree_size_type = std::size_t;
  using vertex_iterator = std::vector<VertexIndex>::const_iterator;
  using out_edge_iterator = LevelEdgeIterator<Direction::out>;
  using in_edge_iterator = LevelEdgeIterator<Direction::in>;
  static vertex_descriptor null_vertex() { return kNoVertex; }

  LevelGraph(const Hierarchy& hierarchy, int level);

  [[nodiscard]] const Hierarchy& hierarchy() const { return *hierarchy_; }
  // kNoCluster on level 0.
  [[nodiscard]] ClusterIndex cluster_of(VertexIndex v) const {
    return level_ == 0 ? kNoCluster : hierarchy_->clustering().cluster_of(v, level_);
  }
  [[nodiscard]] const std::vector<VertexIndex>& vertices() const { return *vertices_; }  // rising
  [[nodiscard]] std::size_t index_of(VertexIndex v) const { return position_of(*vertices_, v); }

 private:
  const Hierarchy* hierarchy_;
  int level_;
  std::shared_ptr<const std::vector<VertexIndex>> vertices_;
};

inline VertexIndex source(const GraphEdge& edge, const LevelGraph&) {
  return edge.from;
}
inline VertexIndex target(const GraphEdge& edge, const LevelGraph&) {
  return edge.to;
}
inline auto out_edges(VertexIndex v, const LevelGraph& graph) {
  return LevelGraph::out_edge_iterator::range(graph.hierarchy(), v, graph.cluster_of(v), Routes::open);
}
inline auto in_edges(VertexIndex v, const LevelGraph& graph) {
  return LevelGraph::in_edge_iterator::range(graph.hierarchy(), v, graph.cluster_of(v), Routes::open);
}
inline std::size_t out_degree(VertexIndex v, const LevelGraph& graph) {
  const auto [first, last] = out_edges(v, graph);
  return static_cast<std::size_t>(std::distance(first, last));
}
inline std::size_t in_degree(VertexIndex v, const LevelGraph& graph) {
  const auto [first, last] = in_edges(v, graph);
  return static_cast<std::size_t>(std::distance(first, last));
}
inline std::size_t degree(VertexIndex v, const LevelGraph& graph) {
  return out_degree(v, graph) + in_degree(v, graph);
}
inline auto vertices(const LevelGraph& graph) {
  return std::pair(graph.vertices().begin(), graph.vertices().end());
}
inline std::size_t num_vertices(const LevelGraph& graph) {
  return graph.vertices().size();
}

// What an edge costs.
struct EdgeCost {
  using key_type = GraphEdge;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;
};
inline double get(EdgeCost, const GraphEdge& edge) {
  return edge.cost;
}
inline EdgeCost get(boost::edge_weight_t, const LevelGraph&) {
  return {};
}
inline double get(boost::edge_weight_t, const LevelGraph&, const GraphEdge& edge) {
  return edge.cost;
}

// From 0 to num_vertices() - 1, in the order of vertices().
struct LevelIndex {
  using key_type = VertexIndex;
  using value_type = std::size_t;
  using reference = std::size_t;
  using category = boost::readable_property_map_tag;
  LevelGraph graph;
};
inline std::size_t get(const LevelIndex& map, VertexIndex v) {
  return map.graph.index_of(v);
}
inline LevelIndex get(boost::vertex_index_t, const LevelGraph& graph) {
  return {graph};
}
inline std::size_t get(boost::vertex_index_t, const LevelGraph& graph, VertexIndex v) {
  return graph.index_of(v);
}

}  // namespace cairn

template <>
struct boost::property_map<cairn::LevelGraph, boost::edge_weight_t> {
  using type = cairn::EdgeCost;
  using const_type = cairn::EdgeCost;
};
template <>
struct boost::property_map<cairn::LevelGraph, boost::vertex_index_t> {
  using type = cairn::LevelIndex;
  using const_type = cairn::LevelIndex;
};
