// Where to stand beside a goal that is blocked, to look at it.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

struct GoalLookout {
  double within_m = 0.5;  // of the goal, from the robot's centre
  double apart_m = 0.3;   // from each place where the robot has stood before
  double before_m = 0.1;  // a place this far before the goal must be in sight: the goal may be drawn inside a wall
};

// The nearest place to the goal that is in reach, in sight of it and not where the robot has stood before.
[[nodiscard]] std::optional<Cell> cell_beside(const Point& goal, const FreeSpace& space,
                                              const std::vector<Point>& stood, const GoalLookout& lookout);

}  // namespace cairn::behaviours
