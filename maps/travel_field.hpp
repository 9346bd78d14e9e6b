// Shortest travel over the grid from one cell to all others: who can be reached, how far, which way.
//
// Dijkstra over 8 neighbours (a diagonal step needs both straight neighbours free) on the cells whose
// distance to the nearest blocked cell is at least a clearance; the start cell always counts as free.
// Deterministic: ties go to the smaller (y, x).
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "maps/distance_field.hpp"

namespace cairn {

class TravelField {
 public:
  // clearance_m: least distance between a crossed cell's centre and a blocked cell's centre.
  // step_weight (>= 1, optional) makes cells dearer than their length, e.g. near walls.
  TravelField(const DistanceField& space, const Point& start_map, double clearance_m,
              const std::function<double(Cell)>& step_weight = {});

  [[nodiscard]] CellBox box() const { return box_; }
  [[nodiscard]] bool reaches(Cell cell) const { return cost_m(cell) < std::numeric_limits<float>::infinity(); }
  [[nodiscard]] float cost_m(Cell cell) const;  // weighted; +inf when not reached
  // From the start to the cell, both included; empty when not reached.
  [[nodiscard]] std::vector<Cell> path_to(Cell cell) const;

 private:
  CellBox box_;
  Cell start_;
  std::vector<float> cost_m_;
  std::vector<std::int8_t> came_from_;  // index of the neighbour towards the start; -1 none
};

// True when every point of the straight segment keeps the clearance (exact grid traversal).
[[nodiscard]] bool segment_is_clear(const DistanceField& space, const Point& from, const Point& to, double clearance_m);
// Drops the corners that a clear straight segment can skip. Ends stay.
[[nodiscard]] std::vector<Point> shortened(const DistanceField& space, const std::vector<Point>& path,
                                           double clearance_m);

}  // namespace cairn
