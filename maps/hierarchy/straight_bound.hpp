// A lower bound of what the cheapest path between two landmarks costs: the straight line, at the least that an open
// route costs a metre.
//
// The bound is consistent with the routes of the network whatever places it was given: a landmark that has moved
// without a report weakens it and does not make it wrong.
#pragma once

#include <vector>

#include "maps/clustering/network.hpp"

namespace cairn {

class StraightBound {
 public:
  StraightBound() = default;
  StraightBound(const LandmarkGraph& graph, const Network& network);

  // After the network has followed a change of the graph. When the place of a landmark was set, all its routes must be
  // added again. The least cost only falls by this; a bound made anew may be sharper.
  void set_place(const LandmarkGraph& graph, const Network& network, VertexIndex v);
  void add_route(const Network& network, RouteId id);

  [[nodiscard]] const Point& place_of(VertexIndex v) const { return places_[v]; }
  // Of the routes of the network; 0: there is no bound.
  [[nodiscard]] double cost_per_m() const;
  // The same when a route between two landmarks costs something else.
  [[nodiscard]] double cost_per_m_with(double cost_per_m, VertexIndex from, VertexIndex to, double cost) const;

 private:
  std::vector<Point> places_;     // by VertexIndex: where a robot is at the landmark
  double cost_per_m_ = kNoRoute;  // of the routes so far
};

}  // namespace cairn
