#include "planners/hybrid/avoided.hpp"

#include <algorithm>

#include "planners/common/disc_space/places.hpp"

namespace cairn {
namespace {

void add_points(const Place& end, const LandmarkGraph& graph, const DiscSpace& space, double radius_m,
                std::vector<Point>& points) {
  if (end.pose) points.push_back(end.pose->position());
  for (const LandmarkId id : end.landmarks)
    if (const Landmark* const landmark = graph.find(id))
      if (const auto approach = approach_pose(space, *landmark, radius_m)) points.push_back(approach->position());
}

std::vector<Cell> cells_under(const OccupancyGrid& grid, const Point& p_map, double radius_m) {
  std::vector<Cell> cells;
  const Lattice lattice{grid.origin_m(), grid.cell_m()};
  (void)any_cell_near(lattice, p_map, p_map, radius_m, [&](Cell cell) {
    if (distance_to_square_m(p_map, p_map, grid.centre_of(cell), grid.cell_m()) < radius_m) cells.push_back(cell);
    return false;
  });
  return cells;
}

}  // namespace

std::optional<OccupancyGrid> with_avoided_blocked(const WorldView& world, const PlanRequest& request,
                                                  const DiscSpace& space, double radius_m) {
  std::vector<Point> ends;
  add_points(request.from, world.graph, space, radius_m, ends);
  add_points(request.to, world.graph, space, radius_m, ends);
  std::optional<OccupancyGrid> blocked;
  for (const LandmarkId id : request.avoid) {
    const Landmark* const landmark = world.graph.find(id);
    const auto approach = landmark != nullptr ? approach_pose(space, *landmark, radius_m) : std::nullopt;
    if (!approach) continue;
    const std::vector<Cell> cells = cells_under(world.grid, approach->position(), radius_m);
    const auto touches_end = [&](Cell cell) {
      return std::any_of(ends.begin(), ends.end(), [&](const Point& end) {
        return distance_to_square_m(end, end, world.grid.centre_of(cell), world.grid.cell_m()) < radius_m;
      });
    };
    if (std::any_of(cells.begin(), cells.end(), touches_end)) continue;
    if (!blocked) blocked = world.grid;
    const auto occupied = static_cast<LogOdds>(space.rules().thresholds.occupied_above + 1);
    for (const Cell cell : cells) blocked->set_log_odds(cell, occupied);
  }
  return blocked;
}

WorldView with_grid(const OccupancyGrid& grid, const WorldView& world) {
  return {grid,
          world.graph,
          world.robot,
          world.pose,
          world.time_s,
          world.observation,
          world.speed_reduction_ratio,
          world.hierarchies,
          &grid == &world.grid ? world.grid_version : 0,
          &grid == &world.grid ? world.cells : nullptr,
          world.T_map_start,
          world.speed_law};
}

}  // namespace cairn
