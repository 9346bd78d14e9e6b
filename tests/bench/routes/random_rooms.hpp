// Maps of rooms for benches that need no data: square rooms in rows, walls one cell thick, doors in most of them.
#pragma once

#include "tests/bench/routes/plain_cells.hpp"

namespace cairn {

struct RoomsShape {
  int side_cells = 512;  // of the whole map
  int room_cells = 31;   // of a room, its walls not counted
  int door_cells = 3;
  double door_ratio = 0.7;     // of the walls between two rooms
  double clutter_ratio = 0.0;  // of the cells inside a room that are closed
  double cell_m = 1.0;
};

// The same seed gives the same map.
[[nodiscard]] PlainCells random_rooms(const RoomsShape& shape, std::uint64_t seed);

// Cells of the largest connected part of the open ones.
[[nodiscard]] std::vector<Cell> largest_part(const PlainCells& cells);

}  // namespace cairn
