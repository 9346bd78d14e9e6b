// Which of several places each cell is nearest to, by travel over a disc lattice, and where these regions meet.
//
// The borders hold a minimum spanning tree of the travel distances between all places (Mehlhorn, "A faster
// approximation algorithm for the Steiner problem in graphs", 1988): places that a disc can drive between are joined
// over borders. One Dijkstra over all places at once, O(cells log cells). Deterministic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "maps/grid/disc_lattice.hpp"

namespace cairn {

class TravelRegions {
 public:
  // Of the lattice's box; a place where the disc does not fit has no region. Of places on one cell the first has the
  // region, and the others border on it alone.
  TravelRegions(const DiscLattice& lattice, std::span<const Cell> places);

  // Two places whose regions meet, as indices, the lower first, and the shortest travel that crosses from the one
  // region into the other and no third.
  struct Border {
    std::size_t first = 0;
    std::size_t second = 0;
    double length_m = 0.0;
    Cell in_first;  // the cells on both sides of the crossing
    Cell in_second;
  };
  // One a pair, by rising length, then by the indices.
  [[nodiscard]] const std::vector<Border>& borders() const { return borders_; }
  // That travel, from the first place to the second, both included.
  [[nodiscard]] std::vector<Cell> path_across(const Border& border) const;

 private:
  static constexpr std::int32_t kNobody = -1;

  [[nodiscard]] std::size_t index_of(Cell cell) const;
  [[nodiscard]] Cell cell_of(std::size_t index) const;
  void settle(const DiscLattice& lattice, std::span<const Cell> places);
  void find_borders(const DiscLattice& lattice);
  void append_way_home(std::vector<Cell>& path, Cell cell) const;

  CellBox box_;
  std::vector<float> cost_m_;
  std::vector<std::int32_t> owner_;     // index of the place, or kNobody
  std::vector<std::int8_t> came_from_;  // the step towards the place; -1 at it
  std::vector<Border> borders_;
};

}  // namespace cairn
