// Which submaps of a saved graph newer ones make superfluous, so that a map that is continued again and again does not
// grow where the robot has been before (compare the overlapping submaps' trimmer of Cartographer).
#pragma once

#include "maps/submaps/kept_submaps.hpp"

namespace cairn {

struct CoverRules {
  int newer = 5;               // so many newer submaps must have an echo at a place
  double covered_ratio = 0.9;  // at so many of a submap's places
};

// Drops submaps that newer ones cover, the newest looked at first; nodes that no submap is left of, and edges that
// lose an end. submap_m: as in nodes_of(). A place is a cell of 0.1 m; an echo beside it counts, as the same wall falls
// now into the one cell, now into the next. There must be no fault. O(cells * log cells).
void drop_covered(KeptSubmaps& submaps, double submap_m, const CoverRules& rules = {});

}  // namespace cairn
