// Sobel gradients of OG1 over a box of cells (paper section 3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn::template_matcher {

// 3x3 Sobel responses of OL, x to the right, y up: whole numbers within +-1020.
class GradientField {
 public:
  // So many cells may be read beyond the end of any row.
  static constexpr int kPadding = 64;

  GradientField() = default;  // of no cells
  GradientField(const OccupancyGrid& grid, const CellBox& box) { look_at(grid, box); }

  // Takes the gradients of another box; its memory serves again.
  void look_at(const OccupancyGrid& grid, const CellBox& box);

  [[nodiscard]] CellBox box() const { return box_; }
  // Gradients of the cells (cell.x, cell.x + 1, ...) of a row; the row above begins `stride` further.
  [[nodiscard]] const std::int16_t* x_from(Cell cell) const { return x_.data() + index_of(cell); }
  [[nodiscard]] const std::int16_t* y_from(Cell cell) const { return y_.data() + index_of(cell); }
  // Both in one, x in the low half.
  [[nodiscard]] const std::int32_t* both_from(Cell cell) const { return both_.data() + index_of(cell); }
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(box_.width()); }

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * stride() + static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;
  std::vector<std::int16_t> x_;
  std::vector<std::int16_t> y_;
  std::vector<std::int32_t> both_;
  std::vector<std::uint8_t> ol_;  // kept for its memory only
};

}  // namespace cairn::template_matcher
