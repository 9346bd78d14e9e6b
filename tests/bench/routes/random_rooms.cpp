#include "tests/bench/routes/random_rooms.hpp"

#include <map>
#include <random>

namespace cairn {

PlainCells random_rooms(const RoomsShape& shape, std::uint64_t seed) {
  const int step = shape.room_cells + 1;
  PlainCells cells{shape.side_cells, shape.side_cells, {}, {0.0, 0.0}, shape.cell_m};
  const auto n = static_cast<std::size_t>(shape.side_cells);
  cells.open.assign(n * n, 1);
  std::mt19937_64 random(seed);
  std::bernoulli_distribution is_clutter(shape.clutter_ratio);
  std::bernoulli_distribution has_door(shape.door_ratio);
  for (int y = 0; y < shape.side_cells; ++y)
    for (int x = 0; x < shape.side_cells; ++x)
      if (x % step == 0 || y % step == 0 || is_clutter(random)) cells.open[cells.index(x, y)] = 0;
  std::uniform_int_distribution<int> door_at(1, shape.room_cells - shape.door_cells + 1);
  for (int y = 0; y < shape.side_cells; y += step)
    for (int x = 0; x < shape.side_cells; x += step)
      for (const bool upright : {false, true}) {
        const int begin = door_at(random);
        if (!has_door(random) || (upright ? x : y) == 0) continue;
        for (int i = begin; i < begin + shape.door_cells; ++i) {
          const Cell door = upright ? Cell{x, y + i} : Cell{x + i, y};
          if (cells.is_inside(door.x, door.y)) cells.open[cells.index(door.x, door.y)] = 1;
        }
      }
  for (int i = 0; i < shape.side_cells; ++i)  // the outer wall is whole
    for (const Cell rim : {Cell{i, shape.side_cells - 1}, Cell{shape.side_cells - 1, i}})
      cells.open[cells.index(rim.x, rim.y)] = 0;
  return cells;
}

std::vector<Cell> largest_part(const PlainCells& cells) {
  const std::vector<std::int32_t> part = parts_of(cells);
  std::map<std::int32_t, std::vector<Cell>> cells_of_part;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      if (cells.is_open(x, y)) cells_of_part[part[cells.index(x, y)]].push_back({x, y});
  std::vector<Cell> largest;
  for (auto& [number, members] : cells_of_part)
    if (members.size() > largest.size()) largest = std::move(members);
  return largest;
}

}  // namespace cairn
