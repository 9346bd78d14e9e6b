// How long a path over landmarks gets once its corners are cut, found before its legs are planned in earnest.
#pragma once

#include <optional>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/hybrid/legs.hpp"

namespace cairn {

// From where the start is left. Legs are the shortest on the first lattice of `routes`, whatever the path planner would
// choose; corners are cut from both ends (answers.hpp). None where a leg is blocked or not found.
[[nodiscard]] std::optional<double> sketched_length_m(const PlanningGround& ground, const DiscRoutes& routes,
                                                      LegRules rules, bool shortcut, const Budget& budget,
                                                      const Point& from, const SymbolicPath& path, const Pose2& goal);

}  // namespace cairn
