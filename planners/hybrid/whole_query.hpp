// Answers one request on the whole grid (docs/method.md 10.4): over landmarks, or directly.
#pragma once

#include "planners/hybrid/answers.hpp"
#include "planners/hybrid/hybrid_query.hpp"
#include "planners/hybrid/legs.hpp"

namespace cairn {

// legs.disc_m is the radius of the disc that has to fit. The world has a grid.
[[nodiscard]] PlanResult answer_on_whole_grid(const HybridTools& tools, const EndRules& ends, const LegRules& legs,
                                              const AnswerRules& answers, const PlanRequest& request,
                                              const WorldView& world, const Budget& budget);

}  // namespace cairn
