// Obstacles where the request avoids landmarks.
#pragma once

#include <optional>
#include <string_view>

#include "framework/contracts/planner.hpp"
#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// The world's grid with an obstacle at each avoided landmark: the cells that a disc at its approach pose would cover
// (approach_pose() in `space`, the world's own). So whatever plans, cuts or checks on this grid keeps out. Where one
// of the request's ends would touch the obstacle, there is none: the robot has to be there. None when nothing is
// to be blocked. The request's poses must be finite.
[[nodiscard]] std::optional<OccupancyGrid> with_avoided_blocked(const WorldView& world, const PlanRequest& request,
                                                                const DiscSpace& space, double radius_m);
// For an answer that finds no path on that grid, as the end of a sentence.
inline constexpr std::string_view kAvoidedCount = "; the places of avoided landmarks count as blocked";

// The same world on another grid.
[[nodiscard]] WorldView with_grid(const OccupancyGrid& grid, const WorldView& world);

}  // namespace cairn
