// Shortest paths of a point over open cells, the plain way: every outward corner is a vertex, every pair that
// sees each other an edge. In whole numbers, so that touching and crossing are distinguished exactly. The oracle
// of the mesh search; small maps only.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/cell.hpp"

namespace cairn::test {

struct OpenCells {
  CellBox box;
  std::vector<std::uint8_t> open;  // row-major

  [[nodiscard]] bool is_open(int x, int y) const {
    return box.contains({x, y}) && open[static_cast<std::size_t>((y - box.min.y) * box.width() + x - box.min.x)] != 0;
  }
};

// '#' is closed; the first line is the top row. The lower left cell is `corner`.
[[nodiscard]] OpenCells drawn_cells(const std::string& drawing, Cell corner = {0, 0});
[[nodiscard]] OpenCells random_cells(std::mt19937_64& random, int width, int height, double closed_ratio);
[[nodiscard]] std::string drawing_of(const OpenCells& cells, const std::vector<Point>& path = {});

// Ends are whole or half numbers. The segment may touch closed cells, not enter them, nor pass between two that
// share a side or a corner.
[[nodiscard]] bool sees(const OpenCells& cells, const Point& a, const Point& b);
// +inf when there is no path.
[[nodiscard]] double plain_shortest_length(const OpenCells& cells, const Point& from, const Point& to);

}  // namespace cairn::test
