// A way over stored routes that needs no look at the rest of a large grid.
#pragma once

#include <optional>

#include "planners/hybrid/answers.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

// Between landmarks: the cheapest way over the graph, when all its trajectories are free and it is so short that no
// direct way could be preferred to it. Looks closely at the grid along that way only, coarsely at the rest where the
// straight line is not enough to tell (length_lower_bound.hpp), and answers what a full look would; none where that is
// not certain.
[[nodiscard]] std::optional<PlanResult> stored_route(const HybridTools& tools, const LegRules& legs,
                                                     const AnswerRules& answers, const PlanRequest& request,
                                                     const WorldView& world, const Budget& budget);

}  // namespace cairn
