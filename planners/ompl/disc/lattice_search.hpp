// The cheapest route over a lattice of cells, and along a route that is known.
#pragma once

#include <vector>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

struct LatticeRoute {
  std::vector<Point> points;   // ends included; empty: none found
  std::vector<bool> is_known;  // for each: of the known route, where no node of the lattice lies as well; never an end
};

// What is known beforehand: the ends of the route, or a whole route between them and its cost (+inf: the ends alone).
struct KnownRoute {
  std::vector<Point> points;
  double cost = 0.0;
};

// A* over every `stride`th cell, 8 neighbours, more of them left out where that is more than half a million nodes, and
// over the points of the known route, which is left and joined at any node beside it: a passage that no node happens
// to lie in is passed along it. Among routes that cost hardly more than the known one. Empty where nodes would be more
// than 0.5 m apart, where nothing joins the ends, and when the budget ends the search. O(n log n) of the nodes through
// which such routes lead.
[[nodiscard]] LatticeRoute lattice_route(const DiscRoutes& routes, const TravelCost& cost, const KnownRoute& known,
                                         int stride, const Budget& budget);

}  // namespace cairn
