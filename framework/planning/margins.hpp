// Room beside the robot: a planner is asked for the most first, and for less where that leaves no path, a much longer
// one, or stored routes that only the margin blocks.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/planning/tour.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// As drives of missions ask for it (`clearances_m`).
inline constexpr std::array<double, 3> kMargins_m{0.12, 0.06, 0.0};
// Those of a disc on a grid; none otherwise: planners check outlines with a margin of their own.
[[nodiscard]] std::vector<double> usual_margins_m(const RobotModel& robot, const OccupancyGrid& grid);

// request.radius_m: of the robot. The margins are tried in their order on top of it, the last is what the others are
// compared with. A margin is relaxed when it leaves no path, when its path is more than kMaxMarginDetour times as long
// as that of the last margin, or when it blocks stored routes which the last one does not. The result's clearance_m
// counts from the robot's edge, and its reason says when the first margin was relaxed and why. When none has a path,
// the result is that of the last.
inline constexpr double kMaxMarginDetour = 1.2;
[[nodiscard]] PlanResult plan_with_margins(const PlanCall& plan, const PlanRequest& request,
                                           std::span<const double> margins_m);

}  // namespace cairn
