#include "framework/reporting/grid_tiles.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr int kTileShift = 6;
static_assert(OccupancyGrid::kTileSide == 1 << kTileShift);

}  // namespace

GridTile copied_tile(const OccupancyGrid& grid, Cell tile) {
  GridTile copied{tile, {}};
  const LogOdds* const cells = grid.cells_of_tile(tile);
  for (std::size_t i = 0; i < copied.ol.size(); ++i) copied.ol[i] = cells == nullptr ? kUnknownOl : ol_of(cells[i]);
  return copied;
}

std::vector<Cell> tiles_touched(const CellChanges& changes) {
  std::vector<Cell> touched;
  for (const CellSpan& span : changes.spans)
    for (int x = span.x_begin >> kTileShift; x <= (span.x_end - 1) >> kTileShift; ++x)
      if (const Cell tile{x, span.y >> kTileShift}; touched.empty() || touched.back() != tile) touched.push_back(tile);
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

std::vector<Cell> tiles_written(const OccupancyGrid& grid) {
  std::vector<Cell> tiles;
  const CellBox box = grid.bounds();
  if (box.empty()) return tiles;
  for (int y = box.min.y >> kTileShift; y <= (box.max.y - 1) >> kTileShift; ++y)
    for (int x = box.min.x >> kTileShift; x <= (box.max.x - 1) >> kTileShift; ++x)
      if (grid.cells_of_tile({x, y}) != nullptr) tiles.push_back({x, y});
  return tiles;
}

}  // namespace cairn
