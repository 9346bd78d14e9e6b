// Where to look again when the map has no path: what blocks the likeliest one may have gone, as doors do.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

// What a metre of a path to a lookout costs, against one that is free.
struct LookoutCosts {
  double narrow = 4.0;     // too near to something
  double seen_once = 3.0;  // unknown, but an echo has come through
  double unknown = 15.0;
  double occupied = 20.0;
  double certainly_occupied = 250.0;  // besides, at the map's bound of certainty: a wall costs more than looks at doors
  double looked_at = 12.0;            // less than a wall: a door is looked at twice before one
  double looked_at_radius_m = 0.8;
  static void describe(Fields<LookoutCosts>& fields);
};

struct LookoutRoute {
  Point at{0.0, 0.0};       // what blocks the path
  std::vector<Point> path;  // from the robot to where that can be seen well, stand_off_m away
};

// On the cheapest path when everything may be crossed, what is certainly occupied at the highest cost: a door that was
// seen closed a few times is cheaper than a wall that was seen for long. What was looked at before costs more, so that
// other places are tried. A goal off the map is looked for at the map's edge. None when nothing blocks the path.
// O(cells log cells).
[[nodiscard]] std::optional<LookoutRoute> lookout_route(const FreeSpace& space, const OccupancyGrid& grid,
                                                        const Point& from, const Point& to,
                                                        const std::vector<Point>& looked_at, double stand_off_m,
                                                        const LookoutCosts& costs = {});

}  // namespace cairn::behaviours
