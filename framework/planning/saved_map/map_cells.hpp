// The cells of a large saved map, read as they are asked for.
#pragma once

#include <vector>

#include "framework/contracts/view/cell_source.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

class MapCells : public CellSource {
 public:
  // Both must outlive it. grid: the file's lattice, into which the cells are read.
  MapCells(const MapFile& file, OccupancyGrid& grid);

  // In pieces of some tiles. Throws StoreError.
  void require(const CellBox& cells) const override;

 private:
  void read(Cell piece) const;

  const MapFile& file_;
  OccupancyGrid& grid_;
  CellBox pieces_;
  mutable std::vector<bool> is_read_;  // by row of pieces
};

}  // namespace cairn
