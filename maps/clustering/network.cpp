#include "maps/clustering/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cairn {
namespace {

double cost_of(const Route& route, const RouteCost& cost) {
  if (route.closed) return kNoRoute;
  const double value = cost(route);
  if (!std::isfinite(value) || value < 0.0)
    throw std::invalid_argument(
        fmt::format("route {}: a cost must be finite and not negative, got {:f}", route.id, value));
  return value;
}

void set_cost(std::vector<Arc>& arcs, RouteId id, double cost) {
  std::find_if(arcs.begin(), arcs.end(), [id](const Arc& arc) { return arc.route == id; })->cost = cost;
}

}  // namespace

double cost_by_length(const Route& route) {
  return route.cost_m;
}

Network::Network(const LandmarkGraph& graph, const RouteCost& cost) {
  landmark_.reserve(graph.landmarks().size());
  vertex_of_.reserve(graph.landmarks().size());
  for (const auto& [id, landmark] : graph.landmarks()) {
    vertex_of_.emplace(id, end());
    landmark_.push_back(id);
  }
  out_.resize(end());
  in_.resize(end());
  for (VertexIndex v = 0; v < end(); ++v) {
    out_[v].reserve(graph.routes_from(landmark_[v]).size());
    in_[v].reserve(graph.routes_to(landmark_[v]).size());
  }
  ends_.reserve(graph.routes().size());
  for (const auto& [id, route] : graph.routes())
    if (route.from != route.to) add_arc(route, cost_of(route, cost));
}

VertexIndex Network::vertex_of(LandmarkId id) const {
  const auto found = vertex_of_.find(id);
  return found == vertex_of_.end() ? kNoVertex : found->second;
}

std::pair<VertexIndex, VertexIndex> Network::ends_of(RouteId id) const {
  const auto found = ends_.find(id);
  return found == ends_.end() ? std::pair(kNoVertex, kNoVertex) : found->second;
}

const Arc* Network::cheapest(VertexIndex from, VertexIndex to) const {
  const Arc* best = nullptr;
  for (const Arc& arc : out_[from])
    if (arc.other == to && arc.cost < kNoRoute &&
        (best == nullptr || arc.cost < best->cost || (arc.cost == best->cost && arc.route < best->route)))
      best = &arc;
  return best;
}

void Network::add_arc(const Route& route, double cost) {
  const VertexIndex from = vertex_of(route.from);
  const VertexIndex to = vertex_of(route.to);
  out_[from].push_back({cost, route.id, to});
  in_[to].push_back({cost, route.id, from});
  ends_.emplace(route.id, std::pair(from, to));
}

void Network::drop_arc(RouteId id) {
  const auto [from, to] = ends_of(id);
  const auto is_it = [id](const Arc& arc) { return arc.route == id; };
  std::erase_if(out_[from], is_it);
  std::erase_if(in_[to], is_it);
  ends_.erase(id);
}

void Network::sync_landmark(const LandmarkGraph& graph, LandmarkId id) {
  const VertexIndex v = vertex_of(id);
  const bool wanted = graph.find(id) != nullptr;
  if (wanted == (v != kNoVertex)) return;
  if (!wanted) {
    if (!out_[v].empty() || !in_[v].empty())
      throw std::logic_error(fmt::format("Network: landmark {} still has routes", id));
    landmark_[v] = 0;
    vertex_of_.erase(id);
    free_.push_back(v);
    return;
  }
  const VertexIndex fresh = free_.empty() ? end() : free_.back();
  if (free_.empty()) {
    landmark_.push_back(id);
    out_.emplace_back();
    in_.emplace_back();
  } else {
    free_.pop_back();
    landmark_[fresh] = id;
  }
  vertex_of_.emplace(id, fresh);
}

void Network::sync_route(const LandmarkGraph& graph, RouteId id, const RouteCost& cost) {
  const Route* const route = graph.find_route(id);
  const auto [from, to] = ends_of(id);
  const bool known = from != kNoVertex;
  const bool wanted = route != nullptr && route->from != route->to;
  const bool same_ends = known && wanted && landmark_of(from) == route->from && landmark_of(to) == route->to;
  if (known && !same_ends) drop_arc(id);
  if (!wanted) return;
  const double value = cost_of(*route, cost);
  if (!same_ends) {
    add_arc(*route, value);
  } else {
    set_cost(out_[from], id, value);
    set_cost(in_[to], id, value);
  }
}

}  // namespace cairn
