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
};
[[nodiscard]] std::string_view name_of(PlanOutcome outcome);

}  // namespace cairn
