// Shortest travel over the grid from one cell to all others: who can be reached, how far, which way.
//
// Dijkstra over 8 neighbours (a diagonal step needs both straight neighbours free) on the cells whose
// distance to the nearest blocked cell is at least a clearance; the start cell always counts as free
// (the robot stands there). A start outside the field's box reaches nothing.
// Deterministic: ties go to the smaller (y, x). O(cells log cells).
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "maps/grid/distance_field.hpp"

namespace cairn {

class TravelField {
 public:
  // clearance_m: least distance between a crossed cell's centre and a blocked cell's centre.
  // step_weight (>= 1, optional) makes cells dearer than their length, e.g. near walls; a step costs
  // its length times the mean weight of its two cells, so that there and back cost the same. It is
  // asked once a cell; throws std::invalid_argument when it answers less than 1.
  // enough (optional) is asked with each cell as it is settled, in order of cost; once it is true, cells not settled
  // by then need not be reached, and their costs and paths need not be the least.
  TravelField(const DistanceField& space, const Point& start_map, double clearance_m,
              const std::function<double(Cell)>& step_weight = {}, const std::function<bool(Cell)>& enough = {});

  [[nodiscard]] CellBox box() const { return box_; }
  [[nodiscard]] bool reaches(Cell cell) const { return cost_m(cell) < std::numeric_limits<float>::infinity(); }
  [[nodiscard]] float cost_m(Cell cell) const;  // weighted; +inf when not reached
  // From the start to the cell, both included; empty when not reached.
  [[nodiscard]] std::vector<Cell> path_to(Cell cell) const;

 private:
  [[nodiscard]] std::size_t index_of(Cell cell) const;

  CellBox box_;
  Cell start_;
  std::vector<float> cost_m_;
  std::vector<std::int8_t> came_from_;  // index of the neighbour towards the start; -1 none
};

// True when every cell that the straight segment touches is crossable and at least clearance_m, centre to
// centre, from the nearest blocked one (exact grid traversal). A segment along the line between two
// rows touches both, one through a corner all four cells there. False where it leaves the box.
[[nodiscard]] bool segment_is_clear(const DistanceField& space, const Point& from, const Point& to, double clearance_m);
// Drops the corners that a clear straight segment can skip, until none is left that can. Ends stay.
[[nodiscard]] std::vector<Point> shortened(const DistanceField& space, const std::vector<Point>& path,
                                           double clearance_m);

}  // namespace cairn
