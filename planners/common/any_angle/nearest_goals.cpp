#include "planners/common/any_angle/nearest_goals.hpp"

#include <algorithm>

namespace cairn {

std::vector<RankedGoal> nearest_first(const std::vector<GoalPlace>& goals, const Point& from, const DiscRoutes& routes,
                                      const Budget& budget) {
  std::vector<RankedGoal> ranked;
  ranked.reserve(goals.size());
  for (const GoalPlace& goal : goals)
    ranked.push_back({goal, goals.size() == 1 ? 0.0 : routes.length_lower_bound_m(from, goal.pose.position(), budget)});
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedGoal& a, const RankedGoal& b) {
    return a.length_lower_bound_m < b.length_lower_bound_m;
  });
  return ranked;
}

}  // namespace cairn
