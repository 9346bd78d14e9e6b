#include "plugins/behaviours/local_map/moved_cells.hpp"

#include <cmath>
#include <map>

namespace cairn::behaviours {
namespace {

constexpr double kBlock_m = 0.5;  // all cells of such a square move alike: looking for the way near by takes long

}  // namespace

CellSet moved_cells(const MapMove& move, const OccupancyGrid& grid, const CellSet& cells) {
  std::map<Cell, Pose2> moves;  // by block
  return cells.mapped([&](Cell cell) {
    const Point at_m = grid.centre_of(cell);
    const Cell block{static_cast<int>(std::floor(at_m.x() / kBlock_m)),
                     static_cast<int>(std::floor(at_m.y() / kBlock_m))};
    auto known = moves.find(block);
    if (known == moves.end()) {
      const Point middle_m = kBlock_m * Point(block.x + 0.5, block.y + 0.5);
      known = moves.emplace(block, move.near(middle_m)).first;
    }
    return grid.cell_at(known->second * at_m);
  });
}

}  // namespace cairn::behaviours
