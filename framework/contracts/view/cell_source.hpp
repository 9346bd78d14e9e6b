// Where the cells of a grid come from that is not whole in memory.
#pragma once

#include "maps/grid/cell.hpp"

namespace cairn {

class CellSource {
 public:
  virtual ~CellSource() = default;
  // From then on the grid holds these cells, as far as the map has them; before, it calls them unknown. What it holds
  // already does not change. For one thread.
  virtual void require(const CellBox& cells) const = 0;
};

}  // namespace cairn
