#include "plugins/behaviours/local_map/speckles.hpp"

#include <algorithm>

#include "plugins/behaviours/local_map/cell_layer.hpp"

namespace cairn::behaviours {
namespace {

bool is_at_rim(Cell c, const CellBox& box) {
  return c.x == box.min.x || c.y == box.min.y || c.x == box.max.x - 1 || c.y == box.max.y - 1;
}

}  // namespace

void SpeckleSettings::describe(Fields<SpeckleSettings>& fields) {
  fields.integer("max_occupied_cells", &SpeckleSettings::max_occupied_cells, {0.0, 1e6},
                 "an isolated group with at most so many occupied cells is a speckle, left by somebody who passed");
  fields.integer("max_cells", &SpeckleSettings::max_cells, {0.0, 1e6}, "and with at most so many cells in all");
}

std::vector<Cell> speckles_of(const OccupancyGrid& grid, const CellBox& box, const SpeckleSettings& settings) {
  CellLayer<std::uint8_t> seen(box, 0, 1);
  std::vector<Cell> speckles;
  std::vector<Cell> group;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (seen.at({x, y}) != 0 || grid.state({x, y}) == CellState::free) continue;
      group = {{x, y}};
      seen[{x, y}] = 1;
      int occupied = 0;
      bool is_open = false;
      for (std::size_t i = 0; i < group.size(); ++i) {
        const Cell here = group[i];
        occupied += grid.state(here) == CellState::occupied ? 1 : 0;
        is_open |= is_at_rim(here, box);
        for (const Cell step : kNeighbours) {
          const Cell next = here + step;
          if (!box.contains(next) || seen.at(next) != 0 || grid.state(next) == CellState::free) continue;
          seen[next] = 1;
          group.push_back(next);
        }
      }
      if (!is_open && occupied <= settings.max_occupied_cells && static_cast<int>(group.size()) <= settings.max_cells)
        speckles.insert(speckles.end(), group.begin(), group.end());
    }
  }
  std::sort(speckles.begin(), speckles.end());
  return speckles;
}

}  // namespace cairn::behaviours
