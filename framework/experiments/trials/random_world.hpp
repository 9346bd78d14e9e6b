// Random worlds for experiments: a room with landmarks and with things that no template describes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "maps/geometry/contour.hpp"

namespace cairn {

// An experiment's `worlds`.
struct RandomWorldConfig {
  Point smallest_room_m{5.0, 4.5};
  Point largest_room_m{8.0, 6.0};
  int min_landmarks = 1;
  int max_landmarks = 6;
  int max_distractors = 2;
  double size_tolerance_ratio = 0.1;
  double landmark_scale = 1.0;
  double gap_m = 1.2;
  std::optional<double> wall_gap_m;
  std::optional<double> shelf_gap_m;
  int chairs = 0;
  Point start_m{0.6, 0.6};
  double start_gap_m = 0.5;
  int min_movers = 0;
  int max_movers = 0;
  int max_doors = 0;
  static void describe(Fields<RandomWorldConfig>& fields);
};

// The text of a world file. The same seed gives the same layout whatever the specular ratio, the share of
// walls and things whose surface is smooth; a larger ratio makes more of the same surfaces smooth. A room in
// which the things have no place is made larger until they have. Movers go there and back between two places on a
// straight path clear of things; where none is found there is none. Each door leads to one more room, empty, in the
// east. Without movers, doors and chairs the rest is what it is with them, as long as the room is large enough. Shapes
// must not be empty.
[[nodiscard]] std::string random_world_yaml(const RandomWorldConfig& config, const std::vector<LandmarkShape>& shapes,
                                            double specular_ratio, std::uint64_t seed);

}  // namespace cairn
