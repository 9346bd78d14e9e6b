// Openings that look too narrow for the robot, with room behind them.
//
// The width of a beam draws every wall's end into the doorway beside it, so a door passed along its wall
// looks narrower than it is. Seen head on it opens.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/driving/free_space.hpp"

namespace cairn::behaviours {

struct Opening {
  Point at_m{0.0, 0.0};  // where the way gets too narrow
  Cell lookout;          // in front of it, in reach
};

// The cheapest one to get to. squeezed is the same space for a slimmer robot. seen: not within 0.5 m of these.
[[nodiscard]] std::optional<Opening> nearest_opening(const FreeSpace& space, const FreeSpace& squeezed,
                                                     const std::vector<Point>& seen);

// Whether a robot that keeps less room, in the same space, gets to where there is room again.
[[nodiscard]] bool tighter_leads_on(const FreeSpace& space, const FreeSpace& tighter);

// A near and roomy place of the largest room that is free but out of reach; none when each has less than 0.5 m2 for the
// robot's centre or is within 0.5 m of a place that is done with. A door that is closed now is shut before it, or a
// beam drawn across one.
[[nodiscard]] std::optional<Point> room_out_of_reach(const FreeSpace& space, const Point& from,
                                                     const std::vector<Point>& done);

}  // namespace cairn::behaviours
