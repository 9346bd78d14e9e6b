// How the search for a path, a route or a plan ended.
#pragma once

#include <string_view>

namespace cairn {

enum class PlanOutcome {
  solved,
  approximate,  // ends short of the goal; never counts as solved
  start_blocked,
  goal_blocked,
  no_route,
  out_of_budget,
  cancelled,
  unknown_place,
  unsupported,  // the planner does not do what is asked for
};
[[nodiscard]] std::string_view name_of(PlanOutcome outcome);
// Neither another margin, another clearance nor open routes can change that outcome.
[[nodiscard]] constexpr bool is_refusal(PlanOutcome outcome) {
  return outcome == PlanOutcome::unknown_place || outcome == PlanOutcome::unsupported ||
         outcome == PlanOutcome::cancelled;
}

}  // namespace cairn
