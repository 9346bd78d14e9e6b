// A landmark graph as a search needs it: landmarks by dense numbers, routes as arcs with their cost.
//
// A removed landmark's number is free for the next one; numbers have no order. Routes from a landmark to itself
// lead nowhere and are left out.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

using VertexIndex = std::uint32_t;
inline constexpr VertexIndex kNoVertex = std::numeric_limits<VertexIndex>::max();
inline constexpr double kNoRoute = std::numeric_limits<double>::infinity();

// What a route costs a search; finite and not negative. Closed routes cost kNoRoute without being asked.
using RouteCost = std::function<double(const Route&)>;
[[nodiscard]] double cost_by_length(const Route& route);  // cost_m

struct Arc {
  double cost = 0.0;  // kNoRoute: closed
  RouteId route = 0;
  VertexIndex other = kNoVertex;  // the end that is not asked for
};

class Network {
 public:
  // Throws std::invalid_argument on a cost that is negative or not finite.
  Network(const LandmarkGraph& graph, const RouteCost& cost);

  // Brings one landmark, or one route, in line with the graph, whatever happened to it there. A landmark is
  // dropped only after its routes.
  void sync_landmark(const LandmarkGraph& graph, LandmarkId id);
  void sync_route(const LandmarkGraph& graph, RouteId id, const RouteCost& cost);

  [[nodiscard]] VertexIndex vertex_of(LandmarkId id) const;                           // kNoVertex when there is none
  [[nodiscard]] LandmarkId landmark_of(VertexIndex v) const { return landmark_[v]; }  // 0: the number is free
  [[nodiscard]] VertexIndex end() const { return static_cast<VertexIndex>(landmark_.size()); }  // above all numbers
  [[nodiscard]] std::size_t landmarks() const { return vertex_of_.size(); }
  [[nodiscard]] const std::vector<Arc>& out(VertexIndex v) const { return out_[v]; }
  [[nodiscard]] const std::vector<Arc>& in(VertexIndex v) const { return in_[v]; }
  // The ends of a route in the network; kNoVertex twice when it is not there.
  [[nodiscard]] std::pair<VertexIndex, VertexIndex> ends_of(RouteId id) const;
  // The cheapest open arc from one to the other, the lower route among equals; null: none.
  [[nodiscard]] const Arc* cheapest(VertexIndex from, VertexIndex to) const;

 private:
  void add_arc(const Route& route, double cost);
  void drop_arc(RouteId id);

  std::vector<LandmarkId> landmark_;
  std::unordered_map<LandmarkId, VertexIndex> vertex_of_;
  std::unordered_map<RouteId, std::pair<VertexIndex, VertexIndex>> ends_;
  std::vector<VertexIndex> free_;
  std::vector<std::vector<Arc>> out_, in_;
};

}  // namespace cairn
