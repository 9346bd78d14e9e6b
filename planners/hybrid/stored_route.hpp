// A path over stored routes that needs nothing of the rest of a large grid.
#pragma once

#include <optional>

#include "planners/hybrid/answers.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

// Between landmarks: the cheapest route over the graph, when all its trajectories are free and it is so short that no
// direct path could be preferred to it. Examines the grid closely along that route only, coarsely elsewhere when the
// straight line does not decide (length_lower_bound.hpp), and gives the answer of the full search; none where that is
// not certain.
[[nodiscard]] std::optional<PlanResult> stored_route(const HybridTools& tools, const LegRules& legs,
                                                     const AnswerRules& answers, const PlanRequest& request,
                                                     const WorldView& world, const Budget& budget);

}  // namespace cairn
