// The cheapest path by Boost.Graph's A*: over the levels of the hierarchy, refined downward leg by leg; on a graph
// without levels over the landmark graph itself.
#pragma once

#include "planners/landmark_search/graph_search.hpp"
#include "planners/landmark_search/open_clusters.hpp"

namespace cairn {

class QueryGraph;

// The bound is the straight line to the box around the goals, at the least that a route costs a metre (StraightBound):
// consistent, so that the first path to the goal is the cheapest.
class BoostSearch : public GraphSearch {
 public:
  [[nodiscard]] GraphPath find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget) override;

  // What the search knows of a vertex.
  struct Label {
    double cost = kNoRoute;
    double rank = kNoRoute;  // with the bound to the goal
    RouteId route = 0;       // 0: through a cluster, or from the start
    VertexIndex before = kNoVertex;
    std::uint32_t number = 0;  // in the order of discovery
    std::uint8_t colour = 0;   // boost::default_color_type: white
  };

 private:
  class Visitor;

  void search(const Hierarchy& hierarchy, const RouteQuery& query, const QueryGraph& graph, Visitor visitor);
  void refine(const Hierarchy& hierarchy, const QueryGraph& graph, GraphPath& path) const;

  OpenClusters clusters_;
  std::vector<Label> labels_;  // by vertex; as new where no search is under way
  std::vector<VertexIndex> discovered_;
};

}  // namespace cairn
