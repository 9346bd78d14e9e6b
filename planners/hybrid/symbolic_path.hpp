// The symbolic half of a plan: which landmarks to pass, and by which stored routes (METHOD 10).
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "planners/disc_space/ends.hpp"

namespace cairn {

struct SymbolicPath {
  std::vector<LandmarkId> landmarks;  // first to last; the ends of the routes
  std::vector<RouteId> routes;        // from landmark to landmark
  double cost_m = 0.0;                // routes by their cost, the first and last mile by travel
  std::size_t goal = 0;               // index of the goal it leads to
};

struct SymbolicAnswer {
  std::optional<SymbolicPath> path;    // none: no way over at least one stored route
  std::optional<PlanOutcome> stopped;  // cancelled or out_of_budget
  std::int64_t settled = 0;
  std::vector<PlanAlternative> alternatives;
  std::optional<PlanExplanation> explanation;
};

// What a search over landmarks starts from.
struct SymbolicQuery {
  const PlanRequest& request;  // what it says of the landmark graph; its ends are those below
  const WorldView& world;
  const StartPlace& start;
  const std::vector<GoalPlace>& goals;
  const TravelField& travel_from_start;
  double radius_m = 0.22;
  // What a metre of free travel to the first and from the last landmark counts as against a metre of
  // stored route.
  double travel_weight = 1.3;
};

// Ends that are poses are joined to the graph by travel over the grid to every landmark with routes;
// ends that are landmarks are themselves. Routes in `blocked` are left out. One search of the graph planner.
[[nodiscard]] SymbolicAnswer symbolic_path(const SymbolicQuery& query, const std::set<RouteId>& blocked,
                                           const Planner& graph_planner, const Budget& budget);

}  // namespace cairn
