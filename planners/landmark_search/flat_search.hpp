// Boost.Graph's Dijkstra over the whole landmark graph: the plain search that the hierarchical one must equal.
#pragma once

#include "framework/contracts/route_planner.hpp"

namespace cairn {

// As LandmarkSearch, by length only and without alternatives and explanations: a request for one of these is refused.
// Searches the whole graph in each call. O((n + m) log n) with an early stop; thread-safe.
class FlatSearch : public RoutePlanner {
 public:
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override;
};

}  // namespace cairn
