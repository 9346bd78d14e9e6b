// A world of landmarks and routes, without a grid.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/route_planner.hpp"
#include "maps/hierarchy/hierarchies.hpp"

namespace cairn::test {

struct GraphWorld {
  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;

  LandmarkId landmark(double x_m, double y_m) {
    Landmark landmark;
    landmark.T_map_landmark = {x_m, y_m, 0.0};
    return graph.add(landmark);
  }
  RouteId route(LandmarkId from, LandmarkId to, double cost_m, std::vector<Pose2> trajectory = {}) {
    Route route;
    route.from = from;
    route.to = to;
    route.cost_m = cost_m;
    route.trajectory = std::move(trajectory);
    return graph.add_route(route);
  }
  [[nodiscard]] Hierarchies hierarchies() const {
    return {graph, {}, {robot.max_v_mps, robot.max_w_radps, 0.22, nullptr}};
  }
  [[nodiscard]] RouteResult plan(const RoutePlanner& planner, const RouteRequest& request, const Budget& budget = {},
                                 const Hierarchies* of_graph = nullptr) const {
    return planner.plan(request, {grid, graph, robot, {}, 0.0, nullptr, 0.0, of_graph}, budget);
  }
};

[[nodiscard]] inline RouteRequest request(const std::vector<LandmarkId>& from, const std::vector<LandmarkId>& to) {
  RouteRequest request;
  for (const LandmarkId id : from) request.from.push_back({id, 0.0});
  for (const LandmarkId id : to) request.to.push_back({id, 0.0});
  return request;
}

// n landmarks a metre apart, joined in rising order.
[[nodiscard]] inline GraphWorld line_of(int n) {
  GraphWorld world;
  for (int i = 0; i < n; ++i) world.landmark(i, 0.0);
  for (int i = 1; i < n; ++i) world.route(i, i + 1, 1.0);
  return world;
}

}  // namespace cairn::test
