// Small containers over the cells of a grid: one value a cell of a box, a set of cells, groups.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "maps/grid/cell.hpp"

namespace cairn::behaviours {

// The eight neighbours, by rising (y, x).
inline constexpr Cell kNeighbours[8] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

// One value for every cell of a box, row-major; every other cell has the value `outside`.
template <class T>
class CellLayer {
 public:
  CellLayer() = default;
  CellLayer(const CellBox& box, T value, T outside)
      : box_(box), outside_(outside), values_(static_cast<std::size_t>(box.width()) * box.height(), value) {}

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] T at(Cell cell) const { return box_.contains(cell) ? values_[index_of(cell)] : outside_; }
  // Only for cells of the box.
  [[nodiscard]] T& operator[](Cell cell) { return values_[index_of(cell)]; }

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;
  T outside_{};
  std::vector<T> values_;
};

// Asked only "is it in?", and never iterated but into another set, so that its order cannot leak into results.
class CellSet {
 public:
  void insert(Cell cell) { keys_.insert(key_of(cell)); }
  [[nodiscard]] bool contains(Cell cell) const { return keys_.contains(key_of(cell)); }
  // Each of its cells as another one.
  template <class Function>
  [[nodiscard]] CellSet mapped(const Function& to) const {
    CellSet others;
    others.keys_.reserve(keys_.size());
    for (const std::uint64_t key : keys_)
      others.insert(to(Cell{static_cast<std::int32_t>(key >> 32), static_cast<std::int32_t>(key)}));
    return others;
  }

 private:
  static std::uint64_t key_of(Cell cell) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x)) << 32 | static_cast<std::uint32_t>(cell.y);
  }
  std::unordered_set<std::uint64_t> keys_;
};

using CellGroup = std::vector<Cell>;

// Splits cells into groups whose members hang together by steps of at most `reach` cells (chessboard
// distance). Groups come in the order of their first cell.
[[nodiscard]] std::vector<CellGroup> grouped(const std::vector<Cell>& cells, int reach);

}  // namespace cairn::behaviours
