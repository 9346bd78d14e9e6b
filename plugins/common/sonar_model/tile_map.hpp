// Cells' own state beside OG1: tiles of OccupancyGrid::kTileSide squared cells behind a directory, as OG1 has them.
#pragma once

#include <memory>
#include <vector>

#include "maps/grid/cell.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::sonar_model {

[[nodiscard]] constexpr Cell tile_holding(Cell cell) {
  return {cell.x >> 6, cell.y >> 6};
}
[[nodiscard]] constexpr std::size_t place_in_tile(Cell cell) {
  return static_cast<std::size_t>(((cell.y & 63) << 6) | (cell.x & 63));
}
inline constexpr std::size_t kCellsInTile =
    static_cast<std::size_t>(OccupancyGrid::kTileSide) * OccupancyGrid::kTileSide;

// Tile: any value type; a new one is value-initialised. A tile never moves once it is there.
template <class Tile>
class TileMap {
 public:
  // Null where nothing was ever written.
  [[nodiscard]] const Tile* find(Cell tile) const {
    return box_.contains(tile) ? tiles_[slot_of(tile)].get() : nullptr;
  }
  [[nodiscard]] Tile& at(Cell tile) {
    if (!box_.contains(tile)) grow({tile, {tile.x + 1, tile.y + 1}});
    std::unique_ptr<Tile>& slot = tiles_[slot_of(tile)];
    if (!slot) slot = std::make_unique<Tile>();
    return *slot;
  }
  // Memory held, with the directory.
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = tiles_.capacity() * sizeof(tiles_[0]);
    for (const auto& tile : tiles_) sum += tile ? sizeof(Tile) : 0;
    return sum;
  }

 private:
  [[nodiscard]] std::size_t slot_of(Cell tile) const {
    return static_cast<std::size_t>(tile.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(tile.x - box_.min.x);
  }
  void grow(const CellBox& tiles) {
    TileMap grown;
    grown.box_ = united(box_, tiles);
    grown.tiles_.resize(static_cast<std::size_t>(grown.box_.width()) * static_cast<std::size_t>(grown.box_.height()));
    for (int y = box_.min.y; y < box_.max.y; ++y)
      for (int x = box_.min.x; x < box_.max.x; ++x)
        grown.tiles_[grown.slot_of({x, y})] = std::move(tiles_[slot_of({x, y})]);
    *this = std::move(grown);
  }

  CellBox box_;
  std::vector<std::unique_ptr<Tile>> tiles_;  // row-major over box_
};

}  // namespace cairn::sonar_model
