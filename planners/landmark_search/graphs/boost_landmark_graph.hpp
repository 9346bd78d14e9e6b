// The landmark graph as a Boost.Graph model: vertices are landmarks and edges open routes, both by
// rising id, so that searches never depend on hashing.
#pragma once

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cstddef>
#include <vector>

#include "framework/contracts/route_planner.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct RouteEdge {
  double cost_m = 0.0;
  const Route* route = nullptr;
};

struct BoostLandmarkGraph {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, RouteEdge>;

  // Without routes that are closed, in the map or by the request, and routes at landmarks to be avoided (those of
  // the request's ends are kept). Valid as long as the landmark graph does not change.
  explicit BoostLandmarkGraph(const LandmarkGraph& landmarks, const RouteRequest& request = {});

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  [[nodiscard]] std::size_t vertex_of(LandmarkId id) const;  // kNone when there is no such landmark

  std::vector<LandmarkId> ids;  // of the vertices, rising
  Graph graph;
};

}  // namespace cairn
