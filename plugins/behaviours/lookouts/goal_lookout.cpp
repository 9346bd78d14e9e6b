#include "plugins/behaviours/lookouts/goal_lookout.hpp"

#include <algorithm>

namespace cairn::behaviours {
namespace {

bool can_look_at(const Point& place, Cell from, const FreeSpace& space, double before_goal_m) {
  const Point stand = space.centre_of(from);
  const Point towards = stand - place;
  const double before_m = std::min(towards.norm(), before_goal_m);
  return towards.norm() < 1e-9 || space.sees(stand, space.cell_at(place + towards.normalized() * before_m));
}

}  // namespace

std::optional<Cell> cell_beside(const Point& goal, const FreeSpace& space, const std::vector<Point>& stood,
                                const GoalLookout& lookout) {
  const Cell at = space.cell_at(goal);
  std::optional<Cell> nearest;
  double nearest_m = lookout.within_m;
  const int reach = static_cast<int>(nearest_m / space.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      const Point place = space.centre_of(c);
      const double distance_m = (place - goal).norm();
      if (distance_m >= nearest_m || !space.reaches(c) || !can_look_at(goal, c, space, lookout.before_m)) continue;
      if (std::ranges::any_of(stood, [&](const Point& p) { return (p - place).norm() < lookout.apart_m; })) continue;
      nearest_m = distance_m;
      nearest = c;
    }
  }
  return nearest;
}

}  // namespace cairn::behaviours
