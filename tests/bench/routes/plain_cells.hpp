// A lattice of open and closed cells in the plainest form, for baselines and checks that share no code with what
// they are held against. Cell (x, y) is the square [x, x + 1] x [y, y + 1], y up; all outside is closed.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct PlainCells {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> open;  // row by row from below
  // Where the lattice lies on a map.
  Point origin_m{0.0, 0.0};
  double cell_m = 1.0;

  [[nodiscard]] bool is_inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  [[nodiscard]] bool is_open(int x, int y) const { return is_inside(x, y) && open[index(x, y)] != 0; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] Point centre_m(Cell cell) const { return origin_m + cell_m * Point(cell.x + 0.5, cell.y + 0.5); }
};

// Open is what the grid knows to be free.
[[nodiscard]] PlainCells plain_cells(const OccupancyGrid& grid);
// The grid that has these cells, free and occupied for sure.
[[nodiscard]] OccupancyGrid grid_of(const PlainCells& cells);

// A number for each cell, equal where four-neighbour steps over open cells lead from one to the other; -1 on closed
// ones. A diagonal step past two open cells joins nothing that these do not.
[[nodiscard]] std::vector<std::int32_t> parts_of(const PlainCells& cells);

}  // namespace cairn
