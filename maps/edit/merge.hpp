// Two saved maps made one: the second laid into the frame of the first.
#pragma once

#include <string>
#include <vector>

#include "maps/store/map_store.hpp"

namespace cairn {

struct MergeOptions {
  Pose2 T_a_b;          // where b's frame lies in a's
  double near_m = 0.4;  // landmarks of one category no farther apart are one
};

struct MergedMap {
  SavedMap map;
  std::size_t joined_landmarks = 0;   // of b: they are one with a landmark of a
  std::size_t joined_routes = 0;      // of b: a has such a route
  std::vector<std::string> warnings;  // sentences: what could not be kept
};

// Grids: with_evidence_of(). Landmarks: near_pairs() become one, which keeps a's id, place and name (b's, when a has
// none), with the sightings and evidence of both; the others of b get new ids. A name of b that a has too gets a
// suffix, "dock" becomes "dock_2". Routes of b get new ids; one whose ends a joins by a route in the same direction
// that costs the same, but for 2 near_m, is that route. A trajectory of b that would not end where a robot stands at
// a's landmark is left away, the route keeps its cost. Clusters are made anew. How far a mission had come is left away.
// The rest (driven path, properties) is a's; of two robot radii the larger counts, of shapes those that a lacks are
// added. Throws std::invalid_argument for grids of different cell size, std::length_error when the grid would get too
// large.
[[nodiscard]] MergedMap merge_maps(const SavedMap& a, const SavedMap& b, const MergeOptions& options);

}  // namespace cairn
