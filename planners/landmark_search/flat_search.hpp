// Boost.Graph's Dijkstra over the whole landmark graph: the plain search that the hierarchical one must equal.
#pragma once

#include "framework/contracts/planner.hpp"

namespace cairn {

// As LandmarkSearch, by length only and without alternatives and explanations: a request for one of these is refused.
// Looks at the whole graph in each call. O((n + m) log n) with an early stop; thread-safe.
class FlatSearch : public Planner {
 public:
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;
};

}  // namespace cairn
