// Goals in the order in which they are tried.
#pragma once

#include <vector>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/ends.hpp"

namespace cairn {

struct RankedGoal {
  GoalPlace place;
  double length_lower_bound_m = 0.0;  // no route there is shorter; 0 where it was not asked for
};

// By the lower bound of the length of a route to them, equal ones as they come. Not computed for a single goal.
[[nodiscard]] std::vector<RankedGoal> nearest_first(const std::vector<GoalPlace>& goals, const Point& from,
                                                    const DiscRoutes& routes, const Budget& budget);

}  // namespace cairn
