// Answers one request to the hybrid planner.
#pragma once

#include "planners/hybrid/hybrid_planner.hpp"

namespace cairn {

// What the planner brings to every request.
struct HybridTools {
  const HybridConfig& config;
  const PlannerTraits& traits;  // of the path planner
  const HybridGround& usual;
  const HybridGround& avoiding;
  const WindowCache& windows;
  const PathPlanner& path_planner;
  const std::shared_ptr<const RoutePlanner>& route_planner;
};

// Whether its grid is so large that the whole of it is only searched where its routes do not do.
[[nodiscard]] bool is_answered_in_windows(const WorldView& world);

// For a disc that turns on the spot.
[[nodiscard]] PlanResult answer_over_landmarks(const HybridTools& tools, const PlanRequest& request,
                                               const WorldView& world, const Budget& budget);

}  // namespace cairn
