// Office buildings of any size, drawn from a seed, as saved maps with landmarks and routes.
//
// Corridors cross each other every 20 and 50 m, a few are closed by a wall. Rooms with furniture lie on both sides of
// them; each has a door to its corridor, some another one to the next room. Landmarks are the crossings, and places
// inside doors. Routes lead along the corridors and through the doors, in the middle, and join all landmarks.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "maps/store/map_store.hpp"

namespace cairn {

struct BuildingRules {
  double side_m = 100.0;
  int landmarks = 62;  // fewer where there are no more rooms; never fewer than there are crossings
  double cell_m = 0.05;
  double radius_m = 0.22;  // of the robot
  std::uint64_t seed = 1;
};

// The same rules, the same map.
[[nodiscard]] SavedMap building(const BuildingRules& rules);

// Pairs of places anywhere in it where a disc of that radius stands.
[[nodiscard]] std::vector<std::pair<Point, Point>> random_pairs(const OccupancyGrid& grid, double radius_m, int count,
                                                                std::uint64_t seed);

}  // namespace cairn
