// Shortest paths over the landmark graph (METHOD 9): Dijkstra on the flat graph.
#pragma once

#include "framework/contracts/planner.hpp"

namespace cairn {

// Ends are landmarks: from the best of `from` to the cheapest of `to`; ties go the same way every time.
// Closed routes are never used. A pose as an end is an unknown place to this planner. The result's path
// joins the stored trajectories, or the landmarks' standing places where there is none; it is not
// checked against the grid. O((n + m) log n) with an early stop; thread-safe.
class LandmarkSearch : public Planner {
 public:
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;
};

}  // namespace cairn
