// Where cells of a distance field lie, in metres.
#pragma once

#include "maps/grid/distance_field.hpp"

namespace cairn {

struct FieldBox {
  Point low{0.0, 0.0};
  Point high{0.0, 0.0};
};

// From the lower left corner of the first cell to the upper right one of the last.
[[nodiscard]] inline FieldBox box_of(const DistanceField& field, const CellBox& cells) {
  return {field.origin_m() + field.cell_m() * Point(cells.min.x, cells.min.y),
          field.origin_m() + field.cell_m() * Point(cells.max.x, cells.max.y)};
}

}  // namespace cairn
