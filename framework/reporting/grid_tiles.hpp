// The grid in the pieces in which it is stored, as values of their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// The grid's 64 x 64 cells whose lowest is 64 times that cell: row-major from the lowest y, kUnknownOl where unknown.
struct GridTile {
  static constexpr std::size_t kCells = std::size_t{OccupancyGrid::kTileSide} * OccupancyGrid::kTileSide;
  Cell tile;
  std::array<std::uint8_t, kCells> ol;
};

[[nodiscard]] GridTile copied_tile(const OccupancyGrid& grid, Cell tile);
// Each once.
[[nodiscard]] std::vector<Cell> tiles_touched(const CellChanges& changes);
[[nodiscard]] std::vector<Cell> tiles_written(const OccupancyGrid& grid);

}  // namespace cairn
