// Planner: from a place to a place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/world_view.hpp"
#include "maps/hierarchy/cluster_tree.hpp"
#include "maps/hierarchy/route_costs.hpp"

namespace cairn {

// A pose, or any one of some landmarks. With neither the place is unknown.
struct Place {
  std::optional<Pose2> pose;
  bool heading_matters = false;  // of the pose; otherwise its theta is ignored
  std::vector<LandmarkId> landmarks;
  // What each of the landmarks costs besides, in the unit of the request's cost: to get to it at the start, to go on
  // from it at the goal. Empty: nothing.
  std::vector<double> costs;
};

struct PlanRequest {
  Place from;
  Place to;
  double radius_m = 0.22;  // of the disc that must fit
  std::uint64_t seed = 1;
  // Over the landmark graph:
  CostKind cost = CostKind::length;
  std::vector<LandmarkId> avoid;  // not passed; a start or goal may be among them
  std::vector<RouteId> closed;    // not taken, as if the map said so
  int alternatives = 0;           // so many more ways, the cheapest first
  bool explain = false;
};

enum class PlanOutcome {
  solved,
  approximate,  // ends short of the goal; never counts as solved
  start_blocked,
  goal_blocked,
  no_route,
  out_of_budget,
  cancelled,
  unknown_place,
};
[[nodiscard]] std::string_view name_of(PlanOutcome outcome);

struct PlanTimes {
  double graph_ms = 0.0;
  double route_ms = 0.0;
  double total_ms = 0.0;
};

// Another way over the landmark graph.
struct PlanAlternative {
  double cost_m = 0.0;
  std::vector<LandmarkId> landmarks;
  std::vector<RouteId> routes;
};

// How the landmark graph gave its answer.
struct PlanExplanation {
  std::vector<std::int64_t> settled_of_level;    // vertices settled: [0] landmarks one by one, [l] clusters of level l
  std::vector<std::vector<ClusterId>> clusters;  // passed, in order: [0] of level 1, ...
  std::optional<double> cost;                    // by the kind asked for, in its unit; none: the graph has no way
  std::vector<RouteId> closed_in_the_way;        // closed routes that a cheaper way would take
  std::optional<double> cost_with_closed_open;   // of that way; none: no cheaper one
};

// A part of the path and where it came from, in the order of the path.
struct PathSegment {
  enum class Origin {
    stored,    // the trajectory of a stored route, still free today
    straight,  // a straight line that is free
    planned,   // searched on the grid
    cut,       // a corner cut across other pieces
    escape,    // out of a start that is too near to something
  };
  Origin origin = Origin::planned;
  RouteId route = 0;  // whose leg it is; 0: no route's
  double length_m = 0.0;
};
[[nodiscard]] std::string_view name_of(PathSegment::Origin origin);

struct PlanResult {
  PlanOutcome outcome = PlanOutcome::no_route;
  std::string reason;  // a sentence for people
  double cost_m = 0.0;
  double length_m = 0.0;
  double clearance_m = 0.0;             // least distance of the robot's edge to anything not free
  std::vector<LandmarkId> landmarks;    // passed, in order, ends included
  std::vector<RouteId> routes;          // stored routes used, in order
  std::vector<RouteId> blocked_routes;  // stored routes found blocked on the way to this answer
  std::vector<Pose2> path;
  std::vector<PathSegment> segments;
  std::optional<double> length_lower_bound_m;  // no path on this grid can be shorter
  std::int64_t settled = 0;                    // graph vertices settled
  std::vector<PlanAlternative> alternatives;
  std::optional<PlanExplanation> explanation;
  PlanTimes time_ms;
};

class Planner {
 public:
  virtual ~Planner() = default;
  // Thread-safe: many calls at once on one planner. The same request, world and seed give the same
  // path as long as the budget's deadline does not cut the call short.
  [[nodiscard]] virtual PlanResult plan(const PlanRequest& request, const WorldView& world,
                                        const Budget& budget) const = 0;
  // What can be done before anyone waits, when a world will be asked about with discs of that radius. Changes no
  // answer. Thread-safe like plan().
  virtual void prepare(const WorldView& /*world*/, double /*radius_m*/) const {}
};

}  // namespace cairn
