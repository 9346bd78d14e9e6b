// Cells of the grid lattice, and sets of cells.
//
// A lattice cell has signed indices and never changes its index when a grid grows: cell (0, 0)
// has its lower left corner at the grid's origin, whatever has been added on any side.
#pragma once

#include <algorithm>
#include <compare>
#include <vector>

namespace cairn {

struct Cell {
  int x = 0;
  int y = 0;
  auto operator<=>(const Cell&) const = default;  // NOLINT(modernize-use-nullptr)
};

[[nodiscard]] constexpr Cell operator+(Cell a, Cell b) {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] constexpr Cell operator-(Cell a, Cell b) {
  return {a.x - b.x, a.y - b.y};
}

// Chessboard distance (the paper's Distance8).
[[nodiscard]] constexpr int distance8(Cell a, Cell b) {
  return std::max(std::max(a.x - b.x, b.x - a.x), std::max(a.y - b.y, b.y - a.y));
}

// Half-open box of cells: min is in, max is not.
struct CellBox {
  Cell min;
  Cell max;

  [[nodiscard]] constexpr int width() const { return max.x - min.x; }
  [[nodiscard]] constexpr int height() const { return max.y - min.y; }
  [[nodiscard]] constexpr bool empty() const { return width() <= 0 || height() <= 0; }
  [[nodiscard]] constexpr bool contains(Cell c) const {
    return c.x >= min.x && c.x < max.x && c.y >= min.y && c.y < max.y;
  }
  [[nodiscard]] constexpr CellBox grown(int cells) const {
    return {{min.x - cells, min.y - cells}, {max.x + cells, max.y + cells}};
  }
  bool operator==(const CellBox&) const = default;
};

[[nodiscard]] constexpr CellBox united(const CellBox& a, const CellBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

[[nodiscard]] constexpr CellBox intersected(const CellBox& a, const CellBox& b) {
  const CellBox box{{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
                    {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
  return box.empty() ? CellBox{} : box;
}

// Cells (x_begin .. x_end-1, y) of one row.
struct CellSpan {
  int y = 0;
  int x_begin = 0;
  int x_end = 0;
  bool operator==(const CellSpan&) const = default;
};

// What one map update may have changed. Every cell that changed lies in a span; spans may hold
// cells that did not change. Rows are sorted, spans of one row do not overlap.
struct CellChanges {
  std::vector<CellSpan> spans;

  [[nodiscard]] bool empty() const { return spans.empty(); }
  [[nodiscard]] CellBox box() const {
    CellBox all;
    for (const CellSpan& s : spans) all = united(all, {{s.x_begin, s.y}, {s.x_end, s.y + 1}});
    return all;
  }
};

// Every cell of a box, as for a detector that sees a whole grid at once.
[[nodiscard]] inline CellChanges everything_in(const CellBox& box) {
  CellChanges changes;
  for (int y = box.min.y; y < box.max.y; ++y) changes.spans.push_back({y, box.min.x, box.max.x});
  return changes;
}

}  // namespace cairn
