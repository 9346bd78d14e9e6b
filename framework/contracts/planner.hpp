// Planner (plugin kind `planner`): from a place to a place, for missions, their behaviours and `cairn plan`.
//
// It composes a PathPlanner and a RoutePlanner. One of these alone serves as a planner too
// (adapters/lone_planners.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/place.hpp"
#include "framework/contracts/plan_outcome.hpp"
#include "framework/contracts/route_planner.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn {

struct PlanRequest {
  Place from;
  Place to;
  double radius_m = 0.22;  // of the disc that must fit
  std::uint64_t seed = 1;
  CostKind cost = CostKind::length;
  double speed_mps = 0.0;  // as fast as the path is to be driven; 0: as the robot can
  // Over the landmark graph:
  std::vector<LandmarkId> avoid;  // not passed; a start or goal may be among them
  std::vector<RouteId> closed;    // not taken, as if the map said so
  int alternatives = 0;           // so many more routes, the cheapest first
  bool explain = false;
};

struct PlanTimes {
  double graph_ms = 0.0;
  double route_ms = 0.0;
  double total_ms = 0.0;
};

// A part of the path and where it came from, in the order of the path.
struct PathSegment {
  enum class Origin {
    stored,    // the trajectory of a stored route, still free today
    straight,  // a straight line that is free
    planned,   // searched on the grid
    cut,       // a corner cut across other segments
    escape,    // out of a start that is too near to something
  };
  Origin origin = Origin::planned;
  RouteId route = 0;  // whose leg it is; 0: no route's
  double length_m = 0.0;
};
[[nodiscard]] std::string_view name_of(PathSegment::Origin origin);

// With a path, costs and lengths are finite and not negative.
struct PlanResult {
  PlanOutcome outcome = PlanOutcome::no_route;
  std::string reason;  // a sentence for people
  double cost_m = 0.0;
  double length_m = 0.0;
  double clearance_m = 0.0;             // least distance of the robot's edge to anything not free
  double margin_m = 0.0;                // that was asked for beside the robot, on top of its radius
  std::vector<LandmarkId> landmarks;    // planned over, in order, ends included; of a direct path those at its ends
  std::vector<RouteId> routes;          // stored routes used, in order
  std::vector<RouteId> blocked_routes;  // stored routes found blocked while planning
  std::vector<Pose2> path;
  std::vector<PathSegment> segments;
  std::optional<double> length_lower_bound_m;  // no path on this grid can be shorter
  std::optional<double> driving_time_s;        // by the speed law along the path; none where that is not known
  std::int64_t settled = 0;                    // graph vertices settled
  std::vector<RouteAlternative> alternatives;
  std::optional<RouteExplanation> explanation;
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
  // Whether plan() asks WorldView::cells for what it needs of a grid that is not whole in memory.
  [[nodiscard]] virtual bool requires_cells() const { return false; }
};

template <>
struct PluginTraits<Planner> {
  static constexpr PluginKind kKind = PluginKind::planner;
  using Context = ModuleContext;
};

}  // namespace cairn
