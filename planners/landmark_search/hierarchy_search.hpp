// The exact cheapest path over a hierarchy: both ends search towards each other, and pass every cluster that holds
// nothing of the query by its shortest paths through it (docs/method.md 9.4). On a graph without levels this is
// Dijkstra from both ends.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {

struct SearchEnd {
  VertexIndex vertex = kNoVertex;
  double cost = 0.0;  // of getting to it first, or on from it; not negative
};

struct RouteQuery {
  std::vector<SearchEnd> from, to;          // any one of each
  std::unordered_set<VertexIndex> avoided;  // not passed; a path may begin or end there
  // Routes that cost something else in this query; kNoRoute: not to be taken.
  std::unordered_map<RouteId, double> costs;
};

struct GraphPath {
  double cost = kNoRoute;                      // kNoRoute: there is none; ends included
  std::vector<VertexIndex> vertices;           // from end to end
  std::vector<RouteId> routes;                 // one less
  bool stopped = false;                        // by the budget, before the answer
  std::int64_t settled = 0;                    // by both searches
  std::vector<std::int64_t> settled_of_level;  // [0]: vertices looked at one by one
};

// Space for searches, to be used again for the next one: a search then touches what it settles and no more. Not
// thread-safe; belongs to no hierarchy.
class HierarchySearch {
 public:
  // O(k log k) in the vertices settled. Equal queries give equal paths. budget.iterations: settled vertices.
  [[nodiscard]] GraphPath find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget);

 private:
  using NodeIndex = std::uint32_t;
  static constexpr NodeIndex kNone = static_cast<NodeIndex>(-1);

  struct Label {
    double cost = kNoRoute;
    NodeIndex before = kNone;
    RouteId route = 0;  // 0: through the cluster
  };
  struct Node {
    VertexIndex vertex = kNoVertex;
    ClusterIndex cluster = kNoCluster;  // that is passed as a whole; none: the vertex is looked at itself
    std::uint32_t index = 0;            // in the cluster's boundary
    std::array<Label, 2> label;         // from the start, to the goal
  };
  // Where the two halves of a path meet: at one node, or by a route from one to another.
  struct Meeting {
    NodeIndex left = kNone;
    NodeIndex right = kNone;
    RouteId route = 0;
  };
  using Queue = std::vector<std::pair<double, NodeIndex>>;

  void begin(const Hierarchy& hierarchy, const RouteQuery& query);
  void look_into_clusters_of(VertexIndex v);
  void look_into_clusters_with(RouteId route);
  void run(const Budget& budget, GraphPath& path);
  void settle(int side, NodeIndex at, GraphPath& path);
  void relax_arc(int side, NodeIndex at, const Arc& arc);
  void end_at_avoided(int side, NodeIndex at, const Arc& arc, double reached);
  void relax(int side, NodeIndex to, double cost, NodeIndex before, RouteId route);
  NodeIndex node_at(VertexIndex v);
  NodeIndex node_at(VertexIndex v, ClusterIndex cluster, std::uint32_t index);
  NodeIndex& slot_of(VertexIndex v);
  void grow();
  void unpack(GraphPath& path) const;
  void unpack_step(int side, NodeIndex at, GraphPath& path) const;
  void unpack_passage(ClusterIndex cluster, std::size_t from, std::size_t to, GraphPath& path) const;
  void append(VertexIndex from, VertexIndex to, GraphPath& path) const;
  [[nodiscard]] double cost_of(const Arc& arc) const;

  const Hierarchy* hierarchy_ = nullptr;
  const RouteQuery* query_ = nullptr;
  std::vector<std::uint32_t> opened_;  // by cluster: the query in which it is looked into
  std::uint32_t query_number_ = 0;
  std::vector<NodeIndex> slots_;  // open addressing by vertex; kNone: empty
  std::vector<Node> nodes_;
  std::array<Queue, 2> queues_;
  std::array<double, 2> frontier_{};  // what each queue began with when the present node was taken from one
  double best_ = kNoRoute;
  Meeting meeting_;  // of the best path so far
};

}  // namespace cairn
