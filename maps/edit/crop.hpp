// A part of a saved map, as a map of its own.
#pragma once

#include <string>
#include <vector>

#include "maps/store/map_store.hpp"

namespace cairn {

struct CroppedMap {
  SavedMap map;
  std::size_t landmarks_dropped = 0;
  std::size_t routes_dropped = 0;     // they end outside, or leave on their way
  std::vector<std::string> warnings;  // sentences: what else could not be kept
};

// What lies between two opposite corners: cells by their centres, landmarks by their places, routes with both ends and
// every pose of their trajectory. Frame, lattice and ids stay; the ids of what is gone are not given again. Where a
// robot stands at a landmark is forgotten when it lies outside. Clusters are made anew,
// the progress of a mission is left away. Throws std::invalid_argument
// when a corner is not finite, the box has no width or height, or nothing of the map lies in it.
[[nodiscard]] CroppedMap crop_map(const SavedMap& map, const Point& corner_m, const Point& opposite_m);

}  // namespace cairn
