// Many cells, held as boxes: to take one by its number costs O(log boxes), to hold millions little memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "maps/grid/cell.hpp"

namespace cairn {

// Numbered in the order in which they were added; within a box by rows.
class NumberedCells {
 public:
  // Boxes must not overlap; empty ones are left out.
  void add(const CellBox& box) {
    if (box.empty()) return;
    boxes_.push_back(box);
    ends_.push_back(size() + static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  }

  [[nodiscard]] std::size_t size() const { return ends_.empty() ? 0 : ends_.back(); }
  [[nodiscard]] bool empty() const { return ends_.empty(); }

  // number: below size().
  [[nodiscard]] Cell operator[](std::size_t number) const {
    const auto at = static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), number) - ends_.begin());
    const CellBox& box = boxes_[at];
    const auto width = static_cast<std::size_t>(box.width());
    const std::size_t within = number - (at == 0 ? 0 : ends_[at - 1]);
    return box.min + Cell{static_cast<int>(within % width), static_cast<int>(within / width)};
  }

 private:
  std::vector<CellBox> boxes_;
  std::vector<std::size_t> ends_;  // of each box: the number after its last cell
};

}  // namespace cairn
