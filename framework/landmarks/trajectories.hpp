// Trajectories of routes, checked and made on the grid.
#pragma once

#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// Whether a disc that moves along it touches known free cells only. Exact (swept_disc.hpp); false for an empty one.
[[nodiscard]] bool is_free(std::span<const Pose2> trajectory, const OccupancyGrid& grid, double radius_m);
// From pose to pose over the centres of these cells, with the corners dropped that a disc need not pass.
[[nodiscard]] std::vector<Pose2> trajectory_over(const Pose2& from, std::span<const Cell> cells, const Pose2& to,
                                                 const OccupancyGrid& grid, double radius_m);

}  // namespace cairn
