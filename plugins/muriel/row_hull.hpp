// Which cells of each row lie between the first and the last that was added.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "maps/grid/cell.hpp"

namespace cairn::muriel {

class RowHull {
 public:
  void add(int y, int x_begin, int x_end) {
    CellSpan& row = row_at(y);
    row.x_begin = std::min(row.x_begin, x_begin);
    row.x_end = std::max(row.x_end, x_end);
  }
  [[nodiscard]] CellBox box() const {
    CellBox all;
    for (const CellSpan& row : rows_)
      if (row.x_begin < row.x_end) all = united(all, {{row.x_begin, row.y}, {row.x_end, row.y + 1}});
    return all;
  }
  // Appends the rows that hold something, rising, and forgets them.
  void drain(std::vector<CellSpan>& spans) {
    for (const CellSpan& row : rows_)
      if (row.x_begin < row.x_end) spans.push_back(row);
    rows_.clear();
  }

 private:
  [[nodiscard]] CellSpan& row_at(int y) {
    constexpr int kNone = std::numeric_limits<int>::max();
    if (rows_.empty()) rows_.push_back({y, kNone, -kNone});
    if (y < rows_.front().y) {
      const int missing = rows_.front().y - y;
      rows_.insert(rows_.begin(), static_cast<std::size_t>(missing), {y, kNone, -kNone});
      for (int i = 0; i < missing; ++i) rows_[static_cast<std::size_t>(i)].y = y + i;
    }
    while (y > rows_.back().y) rows_.push_back({rows_.back().y + 1, kNone, -kNone});
    return rows_[static_cast<std::size_t>(y - rows_.front().y)];
  }

  std::vector<CellSpan> rows_;  // one a row, without gaps
};

}  // namespace cairn::muriel
