// The exact cheapest path over a hierarchy: both ends search towards each other, and pass every cluster that holds
// nothing of the query by its shortest paths through it (docs/method.md 9.4). On a graph without levels this is
// Dijkstra from both ends.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "planners/landmark_search/open_clusters.hpp"

namespace cairn {

class HierarchySearch : public GraphSearch {
 public:
  [[nodiscard]] GraphPath find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget) override;

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
  [[nodiscard]] double cost_of(const Arc& arc) const;

  const Hierarchy* hierarchy_ = nullptr;
  const RouteQuery* query_ = nullptr;
  OpenClusters open_;
  std::vector<NodeIndex> slots_;  // open addressing by vertex; kNone: empty
  std::vector<Node> nodes_;
  std::array<Queue, 2> queues_;
  std::array<double, 2> frontier_{};  // what each queue began with when the present node was taken from one
  double best_ = kNoRoute;
  Meeting meeting_;  // of the best path so far
};

}  // namespace cairn
