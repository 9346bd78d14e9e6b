// What tests of joining landmarks share: grids with landmarks on them, and a planner over cells.
#pragma once

#include <cmath>

#include "framework/contracts/planner.hpp"
#include "maps/geometry/segments.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {

inline void fill(OccupancyGrid& grid, const CellBox& box, LogOdds value) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) grid.set_log_odds({x, y}, value);
}

// A landmark of 0.2 m side, on a grid of 0.1 m cells.
inline LandmarkId add_landmark(LandmarkGraph& graph, OccupancyGrid& grid, double x_m, double y_m) {
  Landmark landmark;
  landmark.T_map_landmark = {x_m, y_m, 0.0};
  const Cell at = grid.cell_at({x_m, y_m});
  fill(grid, {{at.x - 1, at.y - 1}, {at.x + 1, at.y + 1}}, 1000);
  return graph.add(landmark);
}

// Shortest paths from cell to cell, and how often it was asked. clearance_m: from a cell's centre to that of the
// nearest blocked one.
class GridPlanner {
 public:
  GridPlanner(const OccupancyGrid& grid, double clearance_m) : grid_(grid), clearance_m_(clearance_m) {}

  PlanResult operator()(const PlanRequest& request) {
    ++asked;
    const DistanceField space(grid_, UnknownPolicy::avoid);
    const TravelField travel(space, request.from.pose->position(), clearance_m_);
    PlanResult result;
    const std::vector<Cell> cells = travel.path_to(space.cell_at(request.to.pose->position()));
    if (cells.empty()) return result;
    result.outcome = PlanOutcome::solved;
    for (const Cell& cell : cells) result.path.push_back({space.centre_of(cell).x(), space.centre_of(cell).y(), 0.0});
    result.length_m = length_of(result.path);
    return result;
  }

  int asked = 0;

 private:
  const OccupancyGrid& grid_;
  double clearance_m_;
};

}  // namespace cairn
