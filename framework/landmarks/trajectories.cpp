#include "framework/landmarks/trajectories.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "maps/grid/swept_disc.hpp"

namespace cairn {

bool is_free(std::span<const Pose2> trajectory, const OccupancyGrid& grid, double radius_m) {
  if (trajectory.empty()) return false;
  Point from = trajectory.front().position();
  return std::ranges::all_of(trajectory, [&](const Pose2& pose) {
    return sweep_is_free(grid, {}, std::exchange(from, pose.position()), pose.position(), radius_m);
  });
}

std::vector<Pose2> trajectory_over(const Pose2& from, std::span<const Cell> cells, const Pose2& to,
                                   const OccupancyGrid& grid, double radius_m) {
  std::vector<Point> points{from.position()};
  for (const Cell cell : cells) points.push_back(grid.centre_of(cell));
  points.push_back(to.position());
  std::vector<Pose2> trajectory{from};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point here = trajectory.back().position();
    if (i + 1 < points.size() && sweep_is_free(grid, {}, here, points[i + 1], radius_m)) continue;
    const Point along = points[i] - here;
    const double theta_rad = along.norm() > 0.0 ? std::atan2(along.y(), along.x()) : trajectory.back().theta_rad;
    trajectory.push_back({points[i].x(), points[i].y(), theta_rad});
  }
  trajectory.back().theta_rad = to.theta_rad;
  return trajectory;
}

}  // namespace cairn
