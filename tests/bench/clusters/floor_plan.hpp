// Floor plans whose rooms are known: generated buildings, and those of the ipa_rooms collection.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct FloorPlan {
  std::string name;
  OccupancyGrid grid;
  CellBox box;
  std::vector<int> room;  // of each cell of the box, row by row; -1: of none. Doorways go to the nearer room
  std::set<std::pair<int, int>> doors;  // rooms that a doorway joins, the lower number first
  [[nodiscard]] int room_at(Cell cell) const;
};

// One or two corridors of 1.5 to 2.4 m with rooms on both sides, doors of 0.8 to 1.2 m onto the corridor and, in one of
// four walls, to the next room; furniture in every room. The same seed gives the same building.
[[nodiscard]] FloorPlan generated_building(std::uint64_t seed);

// With or without furniture, in order of their names; none when the data folder is not there.
[[nodiscard]] std::vector<FloorPlan> ipa_rooms(bool with_furniture);

}  // namespace cairn
