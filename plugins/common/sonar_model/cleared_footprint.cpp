#include "plugins/common/sonar_model/cleared_footprint.hpp"

#include <algorithm>
#include <cmath>

#include "maps/geometry/contour.hpp"

namespace cairn::sonar_model {
namespace {

double inscribed_m(const RobotModel& robot) {
  if (robot.polygon_m.empty()) return robot.radius_m;
  return std::max(0.0, -Contour::polygon_in_place(robot.polygon_m).signed_distance({0.0, 0.0}));
}

}  // namespace

ClearedFootprint::ClearedFootprint(const RobotModel& robot) : radius_m_(inscribed_m(robot)) {}

std::span<const Cell> ClearedFootprint::unknown_under(const OccupancyGrid& grid, const Pose2& T_map_robot) {
  cells_.clear();
  const Point at_m = T_map_robot.position();
  const double cell_m = grid.cell_m();
  if (radius_m_ <= 0.0 || (has_stood_ && (at_m - last_m_).norm() < 0.5 * cell_m)) return cells_;
  const double reach_m = radius_m_ + cell_m;
  if (!grid.can_include(at_m, reach_m + cell_m)) return cells_;
  has_stood_ = true;
  last_m_ = at_m;
  const Cell low = grid.cell_at(at_m - Point(reach_m, reach_m));
  const Cell high = grid.cell_at(at_m + Point(reach_m, reach_m));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const double off_m = (grid.centre_of({x, y}) - at_m).norm();
      const bool is_optimistically_free = off_m <= radius_m_ || (off_m <= reach_m && grid.log_odds({x, y}) <= 0);
      if (is_optimistically_free && grid.state({x, y}) == CellState::unknown) cells_.push_back({x, y});
    }
  return cells_;
}

void ClearedFootprint::take(OccupancyGrid& grid, const Pose2& T_map_robot, std::vector<CellSpan>& changed) {
  for (const Cell cell : unknown_under(grid, T_map_robot)) {
    grid.set_log_odds(cell, kFree);
    changed.push_back({cell.y, cell.x, cell.x + 1});
  }
}

}  // namespace cairn::sonar_model
