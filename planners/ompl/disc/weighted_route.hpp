// Routes that are cheap by another count than their length.
#pragma once

#include <vector>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

// The cheapest over the grid's cells, 8 neighbours, then shortened; empty where cells are too coarse to see the
// way, or when the budget ends the search. O(cells log cells): everything that is as cheap to reach as the goal is
// visited.
[[nodiscard]] std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                                const Point& to, const Budget& budget);
// Drops corners where the straight segment is free and no dearer; those that the budget leaves no time for stay.
[[nodiscard]] std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost,
                                                   const std::vector<Point>& route, double radius_m,
                                                   const Budget& budget);

}  // namespace cairn
