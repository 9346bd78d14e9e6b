// A floor plan with landmarks and routes on it, as a mission would have left them.
#pragma once

#include <cstdint>
#include <map>

#include "maps/landmarks/landmark_graph.hpp"
#include "tests/bench/clusters/floor_plan.hpp"

namespace cairn {

struct ExploredSite {
  LandmarkGraph graph;
  std::map<LandmarkId, int> room_of;
};

// Landmarks at random free places of the largest part of the plan, one for each `area_m2` of it, each joined by the
// shortest path for a robot of 0.22 m radius to its nearest others. The same seed gives the same site.
[[nodiscard]] ExploredSite explored_site(const FloorPlan& plan, double area_m2, std::uint64_t seed);

}  // namespace cairn
