// How much of what the map says against a path is believed.
#pragma once

namespace cairn::behaviours {

// Each level takes less of the map for an obstacle than the one before.
enum class Optimism {
  none,          // all that the map holds occupied or unknown is an obstacle
  no_speckles,   // speckles are not, nor what was looked at and seen through
  unknown_free,  // nor what is unknown
  narrow_gaps,   // nor, besides, what makes an opening narrower than the robot: sonars draw openings too narrow
};

}  // namespace cairn::behaviours
