// RoutePlanner (plugin kind `route_planner`): a route over the landmark graph.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/plan_outcome.hpp"
#include "framework/contracts/world_view.hpp"
#include "maps/clustering/cluster_tree.hpp"
#include "maps/hierarchy/route_costs.hpp"

namespace cairn {

// A landmark at which a route may begin or end.
struct RouteEnd {
  LandmarkId landmark = 0;
  double cost = 0.0;  // in the unit of the request's cost: to get to it at the start, to go on from it at the goal
};

struct RouteRequest {
  std::vector<RouteEnd> from;  // any one of them
  std::vector<RouteEnd> to;
  double radius_m = 0.22;            // of the robot, where the cost depends on it
  CostKind cost = CostKind::length;  // what routes are compared by
  std::vector<LandmarkId> avoid;     // not passed; a start or goal may be among them
  std::vector<RouteId> closed;       // not taken, as if the map said so
  int alternatives = 0;              // so many more, the cheapest first
  bool explain = false;
};

// Another route over the landmark graph.
struct RouteAlternative {
  double cost_m = 0.0;
  std::vector<LandmarkId> landmarks;
  std::vector<RouteId> routes;
};

// How the landmark graph gave its answer.
struct RouteExplanation {
  std::string search;         // the algorithm that answered, for people
  int search_level = 0;       // the highest level on which it settled vertices; 0: the landmark graph itself
  std::string search_reason;  // why this algorithm
  std::vector<std::int64_t> settled_of_level;    // vertices settled: [0] landmarks one by one, [l] clusters of level l
  std::vector<std::vector<ClusterId>> clusters;  // passed, in order: [0] of level 1, ...
  std::optional<double> cost;                    // by the kind asked for, in its unit; none: the graph has no route
  std::vector<RouteId> closed_on_cheaper_path;   // closed routes that a cheaper answer would take
  std::optional<double> cost_with_closed_open;   // of that answer; none: no cheaper one
};

struct RouteResult {
  PlanOutcome outcome = PlanOutcome::no_route;
  std::string reason;                 // a sentence for people
  double cost_m = 0.0;                // by length, whatever routes are compared by
  std::vector<LandmarkId> landmarks;  // passed, in order, ends included
  std::vector<RouteId> routes;        // stored routes used, in order
  std::int64_t settled = 0;           // graph vertices settled
  std::vector<RouteAlternative> alternatives;
  std::optional<RouteExplanation> explanation;
};

class RoutePlanner {
 public:
  virtual ~RoutePlanner() = default;
  // Knows the graph only: that a route can be driven today is not its promise. Thread-safe: many calls at once on one
  // planner. The same request and world give the same route as long as the budget's deadline does not cut the call
  // short.
  [[nodiscard]] virtual RouteResult plan(const RouteRequest& request, const WorldView& world,
                                         const Budget& budget) const = 0;
};

template <>
struct PluginTraits<RoutePlanner> {
  static constexpr PluginKind kKind = PluginKind::route_planner;
  using Context = ModuleContext;
};

}  // namespace cairn
