// Answers that the searches over the landmark graph share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/contracts/route_planner.hpp"

namespace cairn {

// A search asks its budget after so many settled landmarks.
inline constexpr std::int64_t kSettledPerBudgetCheck = 256;

// Why the request cannot be searched, or nothing.
[[nodiscard]] std::string complaint_about(const RouteRequest& request, const LandmarkGraph& graph);
[[nodiscard]] RouteResult stopped_search(const Budget& budget);
[[nodiscard]] std::string no_route_text(const RouteRequest& request, const LandmarkGraph& graph);
// "by 3 stored routes"
[[nodiscard]] std::string by_routes_text(std::size_t routes);

// Costs by length of a path that answers the request; with what its ends cost when these count metres too.
[[nodiscard]] double cost_m_of(const std::vector<LandmarkId>& landmarks, const std::vector<RouteId>& routes,
                               const RouteRequest& request, const LandmarkGraph& graph);
}  // namespace cairn
