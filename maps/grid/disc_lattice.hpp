// Where a disc can stand and drive from cell centre to cell centre, exactly.
//
// It stands at a cell where it touches no blocked cell (swept_disc.hpp), and steps to one of the eight neighbours when
// it touches none on the way. Two cells belong to one part when such steps lead from the one to the other. A disc that
// need not keep to the centres of cells may get through a gap that is wider than it by less than a cell where this one
// does not. Immutable and thread-safe. O(cells) to build; what the distance field leaves open is checked cell by cell.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/distance_field.hpp"

namespace cairn {

class DiscLattice {
 public:
  // The eight neighbours by rising (y, x); k and 7 - k are opposite.
  static constexpr Cell kSteps[8] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

  DiscLattice(const DistanceField& space, double radius_m);

  [[nodiscard]] CellBox box() const { return box_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }
  [[nodiscard]] bool fits(Cell cell) const { return part_of(cell) != 0; }
  [[nodiscard]] bool may_step(Cell from, int step) const {
    return box_.contains(from) && (steps_[index_of(from)] >> step & 1) != 0;
  }
  // The same number for all cells of a part, from 1 on; 0 where the disc does not fit.
  [[nodiscard]] std::int32_t part_of(Cell cell) const { return box_.contains(cell) ? parts_[index_of(cell)] : 0; }

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }
  void number_parts();

  CellBox box_;
  double cell_m_ = 0.0;
  double radius_m_ = 0.0;
  std::vector<std::uint8_t> steps_;  // bit k: step k is free
  std::vector<std::int32_t> parts_;
};

}  // namespace cairn
