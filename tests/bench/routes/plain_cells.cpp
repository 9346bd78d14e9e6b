#include "tests/bench/routes/plain_cells.hpp"

#include <array>

namespace cairn {

PlainCells plain_cells(const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  PlainCells cells;
  cells.width = box.width();
  cells.height = box.height();
  cells.cell_m = grid.cell_m();
  cells.origin_m = grid.origin_m() + grid.cell_m() * Point(box.min.x, box.min.y);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) cells.open.push_back(grid.state({x, y}) == CellState::free ? 1 : 0);
  return cells;
}

OccupancyGrid grid_of(const PlainCells& cells) {
  OccupancyGrid grid(cells.cell_m, 4.0, cells.origin_m);
  const auto clamp = static_cast<LogOdds>(grid.clamp_quanta());
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      grid.set_log_odds({x, y}, cells.is_open(x, y) ? static_cast<LogOdds>(-clamp) : clamp);
  return grid;
}

std::vector<std::int32_t> parts_of(const PlainCells& cells) {
  std::vector<std::int32_t> part(cells.open.size(), -1);
  std::vector<Cell> todo;
  std::int32_t parts = 0;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      if (!cells.is_open(x, y) || part[cells.index(x, y)] >= 0) continue;
      part[cells.index(x, y)] = parts;
      todo.push_back({x, y});
      while (!todo.empty()) {
        const Cell at = todo.back();
        todo.pop_back();
        for (const Cell step : std::array<Cell, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
          const Cell next = at + step;
          if (!cells.is_open(next.x, next.y) || part[cells.index(next.x, next.y)] >= 0) continue;
          part[cells.index(next.x, next.y)] = parts;
          todo.push_back(next);
        }
      }
      ++parts;
    }
  return part;
}

}  // namespace cairn
