#include "maps/hierarchy/straight_bound.hpp"

#include <algorithm>

namespace cairn {
namespace {

// So that rounding does not put the bound above a cost.
constexpr double kSlack_ratio = 1.0 - 1e-9;

}  // namespace

StraightBound::StraightBound(const LandmarkGraph& graph, const Network& network) {
  for (VertexIndex v = 0; v < network.end(); ++v) set_place(graph, network, v);
  for (VertexIndex v = 0; v < network.end(); ++v)
    for (const Arc& arc : network.out(v)) cost_per_m_ = cost_per_m_with(cost_per_m_, v, arc.other, arc.cost);
}

void StraightBound::set_place(const LandmarkGraph& graph, const Network& network, VertexIndex v) {
  if (v >= places_.size()) places_.resize(network.end(), Point::Zero());
  if (const Landmark* const landmark = graph.find(network.landmark_of(v)))
    places_[v] = landmark->approach_pose().position();
}

void StraightBound::add_route(const Network& network, RouteId id) {
  const auto [from, to] = network.ends_of(id);
  if (from == kNoVertex) return;
  for (const Arc& arc : network.out(from))
    if (arc.route == id) cost_per_m_ = cost_per_m_with(cost_per_m_, from, to, arc.cost);
}

double StraightBound::cost_per_m() const {
  return cost_per_m_ < kNoRoute ? cost_per_m_ : 0.0;
}

double StraightBound::cost_per_m_with(double cost_per_m, VertexIndex from, VertexIndex to, double cost) const {
  const double straight_m = (places_[from] - places_[to]).norm();
  return straight_m > 0.0 ? std::min(cost_per_m, kSlack_ratio * (cost / straight_m)) : cost_per_m;
}

}  // namespace cairn
