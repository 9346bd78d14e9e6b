// The JSON of `cairn plan --json`.
#pragma once

#include <string>
#include <vector>

#include "framework/planning/saved_map/map_planner.hpp"
#include "framework/planning/trajectory.hpp"
#include "framework/program/plan/plan_query.hpp"

namespace cairn {

// Its poses with their times; empty where the query asks for none.
[[nodiscard]] std::vector<TrajectoryPoint> trajectory_for(const MapPlanner& planner, const PlanQuery& query,
                                                          const PlanResult& result);
// Ends with its line feed.
[[nodiscard]] std::string json_line_of(const PlanQuery& query, const PlanResult& result, const MapPlanner& planner);
[[nodiscard]] const ClusterTree& clusters_for(const MapPlanner& planner, const PlanResult& result);

}  // namespace cairn
