#include "planners/common/any_angle/nearest_goals.hpp"

#include <algorithm>

namespace cairn {

std::vector<RankedGoal> nearest_first(const std::vector<GoalPlace>& goals, const Point& from, const DiscRoutes& routes,
                                      const Budget& budget) {
  std::vector<RankedGoal> ranked;
  for (const GoalPlace& goal : goals)
    ranked.push_back({goal, goals.size() == 1 ? 0.0 : routes.least_length_m(from, goal.pose.position(), budget)});
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedGoal& a, const RankedGoal& b) { return a.least_length_m < b.least_length_m; });
  return ranked;
}

}  // namespace cairn
