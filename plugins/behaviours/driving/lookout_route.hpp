// Where to look again when the map has no way: what stands across the likeliest one may have gone, as doors do.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/driving/free_space.hpp"

namespace cairn::behaviours {

struct LookoutRoute {
  Point at{0.0, 0.0};       // what is in the way
  std::vector<Point> path;  // from the robot to where that can be seen well, stand_off_m away
};

// The cheapest way when everything may be crossed, what is surely occupied at the highest price: a door that was seen
// closed a few times is cheaper than a wall that was seen for long. What was looked at before is dearer still. A
// goal off the map is looked for at the map's rim. None when nothing stands in the way. O(cells log cells).
[[nodiscard]] std::optional<LookoutRoute> lookout_route(const FreeSpace& space, const OccupancyGrid& grid,
                                                        const Point& from, const Point& to,
                                                        const std::vector<Point>& looked_at, double stand_off_m);

}  // namespace cairn::behaviours
