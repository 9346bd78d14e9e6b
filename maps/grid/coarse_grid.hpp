// OG2: the second level occupancy grid (docs/method.md 3; paper section 3.1).
//
// Coarse cell (k, h) covers the n x n lattice cells [k n, (k+1) n) x [h n, (h+1) n) of OG1 and holds
// their weighted mean OL: weight 1 where OL <= 127, alpha elsewhere. Sums are kept as integers, so
// updating incrementally equals recomputing from nothing to the last bit.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

class CoarseGrid {
 public:
  // Throws std::invalid_argument unless 1 <= n <= 1024 and alpha > 1.
  CoarseGrid(int n, double alpha);

  // Follows the changes of OG1; returns the coarse cells over them, each once, sorted by (y, x).
  // Spans that reach beyond the grid's bounds hold nothing there and are cut. Coarse cells that are
  // new because OG1 grew are computed whole. Costs n^2 reads a coarse cell touched.
  std::vector<Cell> update(const OccupancyGrid& grid, const CellChanges& changes);
  // The same into the caller's vector, whose memory serves again.
  void update(const OccupancyGrid& grid, const CellChanges& changes, std::vector<Cell>& touched);
  // Recomputes everything within the grid's bounds.
  void rebuild(const OccupancyGrid& grid);

  [[nodiscard]] int n() const { return n_; }
  [[nodiscard]] double alpha() const { return alpha_; }
  [[nodiscard]] CellBox bounds() const { return bounds_; }  // in coarse cells
  [[nodiscard]] double ol(Cell coarse) const;               // 127 outside bounds
  [[nodiscard]] Cell coarse_of(Cell fine) const;            // floor division by n
  [[nodiscard]] CellBox fine_box(Cell coarse) const;
  bool operator==(const CoarseGrid&) const = default;

 private:
  struct Sums {
    std::int32_t low_sum = 0;   // OL over cells with OL <= 127
    std::int32_t high_sum = 0;  // OL over the others
    std::int32_t high_count = 0;
    bool operator==(const Sums&) const = default;
  };
  void include(const CellBox& fine_box, const OccupancyGrid& grid);
  [[nodiscard]] Sums sums_of(const OccupancyGrid& grid, Cell coarse) const;
  [[nodiscard]] std::size_t index_of(Cell coarse) const;

  int n_;
  double alpha_;
  CellBox bounds_;
  std::vector<Sums> sums_;  // row-major over bounds_
};

}  // namespace cairn
