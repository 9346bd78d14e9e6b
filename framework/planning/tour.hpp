// Plans over several places in a given order.
#pragma once

#include <functional>
#include <span>

#include "framework/contracts/planner.hpp"

namespace cairn {

using PlanCall = std::function<PlanResult(const PlanRequest&)>;

// From request.from through each place to request.to, leg by leg; a place that is any one of several landmarks is
// the one that is cheapest from the place before. The first leg that is not solved gives the outcome, and its reason
// says which it was. Costs, lengths, times, landmarks, routes and paths are those of the legs so far; so are settled
// vertices and, as far as they add up, explanations: when a leg has no route over the graph, even with every closed
// route open, then neither has the tour. Alternatives of a tour are not known: none are given.
[[nodiscard]] PlanResult plan_tour(const PlanCall& plan, PlanRequest request, std::span<const Place> via);

}  // namespace cairn
