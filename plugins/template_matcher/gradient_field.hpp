// Sobel gradients of OG1 over a box of cells (paper section 3.3).
#pragma once

#include <vector>

#include "maps/occupancy_grid.hpp"

namespace cairn::template_matcher {

// 3x3 Sobel responses of OL, x to the right, y up: whole numbers within +-1020. They are held as
// floats because sums of their squares stay below 2^23, where a float is exact, and a vector unit
// has a correctly rounded square root for floats: every machine gets the same bits.
class GradientField {
 public:
  // Rows are padded on the right, so that kPadding cells more than the box may be read.
  static constexpr int kPadding = 8;

  GradientField(const OccupancyGrid& grid, const CellBox& box);

  [[nodiscard]] CellBox box() const { return box_; }
  // Gradients of the cells (cell.x, cell.x + 1, ...) of a row.
  [[nodiscard]] const float* x_from(Cell cell) const { return x_.data() + index_of(cell); }
  [[nodiscard]] const float* y_from(Cell cell) const { return y_.data() + index_of(cell); }

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width() + kPadding) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace cairn::template_matcher
