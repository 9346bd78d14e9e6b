// Where does one saved map lie in another that shows some of the same building? By their landmarks and by what their
// grids have in common; no pose is given.
//
// Guesses come from two landmarks that are as far apart in both maps, and from parts of b that are searched for in the
// whole of a (maps/relocalisation/pose_search.hpp). Each is judged by all that both maps know: b's walls on a's, b's
// free places on a's, landmarks on landmarks. One is taken when enough is shared, next to nothing contradicts it, and
// no other guess comes near it. Deterministic.
#pragma once

#include <optional>
#include <string>

#include "maps/store/map_store.hpp"

namespace cairn {

struct AlignmentRules {
  double window_m = 4.0;  // half a side of the parts of b
  double window_every_m = 3.0;
  int max_windows = 20;
  std::size_t enough_landmarks = 4;  // that coincide: parts of b are not searched for
  double near_m = 0.4;               // landmarks of one category
  double min_shared_wall_m2 = 0.5;   // of b's occupied area on what a knows
  double min_wall_ratio = 0.9;       // of that on a's walls, or beside them
  double max_contradicted_ratio = 0.02;
  double clear_ratio = 0.8;          // no other guess scores more than this, of the best
  double apart_m = 0.5;              // two guesses farther apart than that,
  double apart_rad = radians(10.0);  // or turned by more, are two
};

struct MapAlignment {
  Pose2 T_a_b;
  double wall_ratio = 0.0;            // of b's walls where a knows anything: on a's walls
  double contradicted_ratio = 0.0;    // of all of b's points there: wall in the open, or free on a wall
  double shared_m2 = 0.0;             // known in both
  double shared_wall_m2 = 0.0;        // of that, b's walls
  std::size_t landmarks = 0;          // that coincide
  std::size_t missing_landmarks = 0;  // of either map, where the other knows the place and has none
};

struct AlignmentResult {
  std::optional<MapAlignment> alignment{};
  std::string reason{};  // a sentence, when there is none
};

// Throws std::invalid_argument for cells of different size.
[[nodiscard]] AlignmentResult align_maps(const SavedMap& a, const SavedMap& b, const AlignmentRules& rules = {});

}  // namespace cairn
