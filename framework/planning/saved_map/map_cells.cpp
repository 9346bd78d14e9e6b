#include "framework/planning/saved_map/map_cells.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr int kPieceTiles = 4;
constexpr int kPieceCells = kPieceTiles * OccupancyGrid::kTileSide;

CellBox pieces_of(const CellBox& cells) {
  const auto piece_of = [](int cell) {
    return cell >= 0 ? cell / kPieceCells : -((kPieceCells - 1 - cell) / kPieceCells);
  };
  if (cells.empty()) return {};
  return {{piece_of(cells.min.x), piece_of(cells.min.y)},
          {piece_of(cells.max.x - 1) + 1, piece_of(cells.max.y - 1) + 1}};
}

}  // namespace

MapCells::MapCells(const MapFile& file, OccupancyGrid& grid)
    : file_(file),
      grid_(grid),
      pieces_(pieces_of(grid.bounds())),
      is_read_(static_cast<std::size_t>(pieces_.width()) * static_cast<std::size_t>(pieces_.height()), false) {}

void MapCells::require(const CellBox& cells) const {
  const CellBox pieces = pieces_of(intersected(cells, grid_.bounds()));
  for (int y = pieces.min.y; y < pieces.max.y; ++y)
    for (int x = pieces.min.x; x < pieces.max.x; ++x) {
      const std::size_t at = static_cast<std::size_t>(y - pieces_.min.y) * static_cast<std::size_t>(pieces_.width()) +
                             static_cast<std::size_t>(x - pieces_.min.x);
      if (is_read_[at]) continue;
      read({x, y});
      is_read_[at] = true;
    }
}

void MapCells::read(Cell piece) const {
  const Cell tile{piece.x * kPieceTiles, piece.y * kPieceTiles};
  const Cell low{piece.x * kPieceCells, piece.y * kPieceCells};
  const OccupancyGrid part = file_.grid_within({low, low + Cell{kPieceCells, kPieceCells}});
  for (int y = tile.y; y < tile.y + kPieceTiles; ++y)
    for (int x = tile.x; x < tile.x + kPieceTiles; ++x)
      if (const LogOdds* const cells = part.cells_of_tile({x, y}))
        std::copy_n(cells, OccupancyGrid::kTileSide * OccupancyGrid::kTileSide,
                    grid_.cells_of_tile_for_writing({x, y}));
}

}  // namespace cairn
