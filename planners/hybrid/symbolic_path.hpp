// The symbolic half of a plan: which landmarks to pass, and by which stored routes (docs/method.md 10.4).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "planners/common/disc_space/ends.hpp"

namespace cairn {

struct SymbolicPath {
  std::vector<LandmarkId> landmarks;  // first to last; the ends of the routes
  std::vector<RouteId> routes;        // from landmark to landmark
  double cost_m = 0.0;                // routes by their cost, the access legs by travel
  std::size_t goal = 0;               // index of the goal it leads to
  bool leaves_its_cluster = false;    // its ends are in different clusters of level 1, of a small graph
};

struct SymbolicAnswer {
  std::optional<SymbolicPath> path;    // none: no path over at least one stored route
  std::optional<PlanOutcome> stopped;  // cancelled or out_of_budget
  std::int64_t settled = 0;
  std::vector<RouteAlternative> candidates;  // that path, then the alternatives asked for
  std::optional<RouteExplanation> explanation;
};

// What a search over landmarks starts from.
struct SymbolicQuery {
  const PlanRequest& request;  // what it says of the landmark graph; its ends are those below
  const WorldView& world;
  const StartPlace& start;
  const std::vector<GoalPlace>& goals;
  double radius_m = 0.22;
  // What a metre of free travel to the first and from the last landmark counts as against a metre of
  // stored route.
  double travel_weight = 1.3;
};

// One end of a search: landmarks, each with the travel between it and the request's end, and the goal that this
// leads to.
class SymbolicEnd {
 public:
  void add(LandmarkId id, double travel_m, std::size_t goal);
  [[nodiscard]] std::vector<RouteEnd> route_ends(double weight) const;
  [[nodiscard]] double travel_m(LandmarkId id) const { return reached_.at(id).travel_m; }
  [[nodiscard]] std::size_t goal(LandmarkId id) const { return reached_.at(id).goal; }
  [[nodiscard]] bool empty() const { return reached_.empty(); }
  void remove(LandmarkId id) { reached_.erase(id); }

 private:
  struct Reached {
    double travel_m = 0.0;
    std::size_t goal = 0;
  };
  std::map<LandmarkId, Reached> reached_;
};

// Ends that are poses are joined to the graph by travel over the grid: to the landmarks with routes of the cluster that
// they lie in, or to all where there are no clusters, or very many landmarks. Ends that are landmarks are themselves.
// Joined once; each find() is one search of the graph planner.
class SymbolicSearch {
 public:
  SymbolicSearch(const SymbolicQuery& query, const RoutePlanner& route_planner, const Budget& budget);
  // Between ends that somebody else has joined.
  SymbolicSearch(const SymbolicQuery& query, const RoutePlanner& route_planner, const Budget& budget, SymbolicEnd start,
                 SymbolicEnd goals)
      : query_(query),
        route_planner_(route_planner),
        budget_(budget),
        start_(std::move(start)),
        goals_(std::move(goals)) {}

  // Routes in `blocked` are left out.
  [[nodiscard]] SymbolicAnswer find(const std::set<RouteId>& blocked) const;

 private:
  const SymbolicQuery& query_;
  const RoutePlanner& route_planner_;
  const Budget& budget_;
  SymbolicEnd start_;
  SymbolicEnd goals_;
};

}  // namespace cairn
