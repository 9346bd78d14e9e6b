// What it takes to drive a route by the speed law.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// From the edge of a robot of that radius at the point to the face of what is blocked next, interpolated between cells:
// exact beside straight walls, within a cell's diagonal elsewhere. Negative where it does not fit.
[[nodiscard]] double edge_clearance_m(const DistanceField& field, const Point& p_map, double radius_m);

// How fast a path of such a robot is driven, and what it keeps from.
struct DrivingRules {
  DrivingPace pace;
  double radius_m = 0.22;  // of the robot itself, without what a request adds to it
};
// None where the robot is not known (WorldView::speed_law) or a point. speed_mps: as in PathRequest.
[[nodiscard]] std::optional<DrivingRules> driving_rules_of(const WorldView& world, double radius_m, double speed_mps);

// Into how many steps a straight segment is divided to be counted: of 0.1 m, the spread of the law, or a cell.
[[nodiscard]] int driving_steps(const DistanceField& field, double length_m);
// Seconds, by the pace in the middle of every step. At least the length times pace.min_s_per_m(). Turning on
// the spot, speeding up and braking are not counted.
[[nodiscard]] double driving_time_s(const DistanceField& field, const Point& from, const Point& to,
                                    const DrivingRules& rules);
[[nodiscard]] double driving_time_s(const DistanceField& field, const std::vector<Point>& route,
                                    const DrivingRules& rules);

}  // namespace cairn
