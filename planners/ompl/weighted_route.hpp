// Routes that are cheap by another count than their length.
#pragma once

#include <vector>

#include "planners/any_angle/disc_routes.hpp"
#include "planners/ompl/travel_cost.hpp"

namespace cairn {

// The cheapest over the grid's cells, 8 neighbours, then shortened; empty where cells are too coarse to see the
// way. O(cells log cells): the whole of what can be reached is looked at.
[[nodiscard]] std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                                const Point& to);
// Drops corners where the straight segment is free and no dearer.
[[nodiscard]] std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost,
                                                   const std::vector<Point>& route, double radius_m);

}  // namespace cairn
