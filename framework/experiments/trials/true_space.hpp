// Where a disc has room in the true world, and which places are joined by such room: what judges whether a goal could
// be reached. Movers are not looked at: they go on.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "framework/contracts/world.hpp"

namespace cairn {

class TrueSpace {
 public:
  // A disc of this radius. Time: cells of the world's bounds times its faces; memory: the cells.
  TrueSpace(const World& world, double radius_m);

  // Between walls and objects, inside the bounds; doors count as open. Exact.
  [[nodiscard]] bool has_room(const Point& p_m) const;

  // Where a disc gets to from there, all doors open: a place a cell; none when there is no room at the place itself.
  [[nodiscard]] std::vector<Point> reached_from(const Point& p_m) const;
  [[nodiscard]] static double cell_m();

  // Cells of a lattice of 0.05 m whose centres have room.
  using Cells = std::vector<std::size_t>;
  [[nodiscard]] Cells cells_near(const Point& p_m, double within_m) const;
  // No farther from the object's outline than that, outside of it.
  [[nodiscard]] Cells cells_beside(const WorldObject& object, double within_m) const;

  // Which doors of the world are closed, in its order.
  using Doors = std::vector<bool>;
  [[nodiscard]] Doors doors_at(double time_s) const;
  // Whether a path with room leads from one of these to one of those. Linear in the cells for doors that were not asked
  // about before.
  [[nodiscard]] bool joined(const Cells& from, const Cells& to, const Doors& closed);

 private:
  [[nodiscard]] Point centre_of(std::size_t cell) const;
  [[nodiscard]] const std::vector<int>& parts(const Doors& closed);
  void fill(std::vector<int>& part, std::size_t from, int number) const;

  World world_;
  double radius_m_;
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> free_;
  std::map<Doors, std::vector<int>> parts_;  // of each cell: from 1; 0 no room
};

}  // namespace cairn
