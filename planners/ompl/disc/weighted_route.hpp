// Routes that are cheap by another count than their length.
#pragma once

#include <vector>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

// The cheapest over a lattice of cells 0.1 m apart, up to 0.5 m where that is more than half a million nodes, 8
// neighbours, then shortened: A*, among routes that cost hardly more than known_cost (of a route that there is; +inf
// where none is known). Empty where there is none, where the lattice is too coarse to see the way or would be coarser
// still, and when the budget ends the search. O(n log n) of the nodes through which such routes lead.
[[nodiscard]] std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                                const Point& to, double known_cost, const Budget& budget);
// Drops corners where the straight segment is free and no dearer; those that the budget leaves no time for stay.
[[nodiscard]] std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost,
                                                   const std::vector<Point>& route, double radius_m,
                                                   const Budget& budget);
[[nodiscard]] double cost_of(const TravelCost& cost, const std::vector<Point>& route);

}  // namespace cairn
