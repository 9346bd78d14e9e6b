// Planner: from a place to a place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn {

// A pose, or any one of some landmarks. With neither the place is unknown.
struct Place {
  std::optional<Pose2> pose;
  bool heading_matters = false;  // of the pose; otherwise its theta is ignored
  std::vector<LandmarkId> landmarks;
};

struct PlanRequest {
  Place from;
  Place to;
  double radius_m = 0.22;  // of the disc that must fit
  std::uint64_t seed = 1;
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
  std::int64_t settled = 0;  // graph vertices settled
  PlanTimes time_ms;
};

class Planner {
 public:
  virtual ~Planner() = default;
  // Thread-safe: many calls at once on one planner. The same request, world and seed give the same
  // path as long as the budget's deadline does not cut the call short.
  [[nodiscard]] virtual PlanResult plan(const PlanRequest& request, const WorldView& world,
                                        const Budget& budget) const = 0;
};

}  // namespace cairn
