// Openings that look too narrow for the robot, with room behind them.
//
// The width of a beam draws every wall's end into the doorway beside it, so a door passed along its wall
// looks narrower than it is. Seen head on it opens.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

struct OpeningSettings {
  double room_behind_m2 = 1.0;
  double room_out_of_reach_m2 = 0.5;
  double room_to_drive_m2 = 0.2;
  double clearance_weight = 4.0;
  double roomy_m = 0.8;
  double same_m = 0.5;
  static void describe(Fields<OpeningSettings>& fields);
};

struct Opening {
  Point at_m{0.0, 0.0};  // where the path gets too narrow
  Cell lookout;          // in front of it, in reach
};

// The cheapest one to get to. narrow is the same space for a slimmer robot. seen: not within same_m of these.
[[nodiscard]] std::optional<Opening> nearest_opening(const FreeSpace& space, const FreeSpace& narrow,
                                                     const std::vector<Point>& seen,
                                                     const OpeningSettings& settings = {});

// Whether a robot that keeps less room, in the same space, gets to where there is room again.
[[nodiscard]] bool tighter_leads_on(const FreeSpace& space, const FreeSpace& tighter,
                                    const OpeningSettings& settings = {});

// A near and roomy place of the largest room that is free but out of reach; none when each has less than
// room_out_of_reach_m2 for the robot's centre or is within same_m of a place that is done with. A door that is closed
// now is shut before it, or a beam drawn across one.
[[nodiscard]] std::optional<Point> room_out_of_reach(const FreeSpace& space, const Point& from,
                                                     const std::vector<Point>& done,
                                                     const OpeningSettings& settings = {});

}  // namespace cairn::behaviours
