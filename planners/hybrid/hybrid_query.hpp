// One request to the hybrid planner on its way to an answer.
#pragma once

#include "planners/hybrid/hybrid_planner.hpp"

namespace cairn {

// What the planner brings to every request.
struct HybridTools {
  const HybridConfig& config;
  UnknownPolicy unknown;
  double margin_m;  // that the route planner adds to a request's radius
  const HybridGround& usual;
  const HybridGround& avoiding;
  const Planner& route;
  const Planner& graph;
};

// For a disc that turns on the spot.
[[nodiscard]] PlanResult answer_over_landmarks(const HybridTools& tools, const PlanRequest& request,
                                               const WorldView& world, const Budget& budget);

}  // namespace cairn
