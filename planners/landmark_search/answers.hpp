// What the searches over the landmark graph say in the same words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/contracts/planner.hpp"

namespace cairn {

// A search asks its budget after so many settled landmarks.
inline constexpr std::int64_t kSettledPerBudgetCheck = 256;

// Why the request cannot be searched, or nothing.
[[nodiscard]] std::string complaint_about(const PlanRequest& request, const LandmarkGraph& graph);
[[nodiscard]] PlanResult stopped_search(const Budget& budget);
[[nodiscard]] std::string no_route_text(const PlanRequest& request, const LandmarkGraph& graph);
// "by 3 stored routes"
[[nodiscard]] std::string by_routes_text(std::size_t routes);

// Costs by length of a way that answers the request; with what its ends cost when these count metres too.
[[nodiscard]] double cost_m_of(const std::vector<LandmarkId>& landmarks, const std::vector<RouteId>& routes,
                               const PlanRequest& request, const LandmarkGraph& graph);
// Fills path and length_m from landmarks and routes: stored trajectories, or standing places where there are none.
void join_trajectories(PlanResult& result, const LandmarkGraph& graph);

[[nodiscard]] double ms_between(Budget::Clock::time_point begin, Budget::Clock::time_point end);

}  // namespace cairn
