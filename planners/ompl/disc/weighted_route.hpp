// Routes that are cheap by another count than their length.
#pragma once

#include <vector>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

// The cheapest over a lattice of cells 0.1 m apart, up to 0.5 m where that is more than half a million nodes, 8
// neighbours, and along a route that is known (empty: none), which leads through passages that no node happens to lie
// in; near narrow places every cell counts. Then shortened: A*, among routes that cost hardly more than the known one.
// Empty where there is none, where the lattice is too coarse or, with nothing known, too coarse to see the way, and
// when the budget ends the search. O(n log n) of the nodes through which such routes lead.
[[nodiscard]] std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost,
                                                const std::vector<Point>& known, const Point& from, const Point& to,
                                                const Budget& budget);
// Drops corners where the straight segment is free and no dearer; those that the budget leaves no time for stay.
[[nodiscard]] std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost,
                                                   const std::vector<Point>& route, double radius_m,
                                                   const Budget& budget);
[[nodiscard]] double cost_of(const TravelCost& cost, const std::vector<Point>& route);

}  // namespace cairn
