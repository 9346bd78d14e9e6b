#include "planners/hybrid/symbolic_path.hpp"

#include <algorithm>
#include <map>

namespace cairn {
namespace {

// One end of the search: landmarks, each with the travel between it and the request's end, and the goal that this
// leads to.
class End {
 public:
  void add(LandmarkId id, double travel_m, std::size_t goal) {
    const auto [at, fresh] = reached_.emplace(id, Reached{travel_m, goal});
    if (!fresh && travel_m < at->second.travel_m) at->second = {travel_m, goal};
  }
  [[nodiscard]] Place place(double weight) const {
    Place place;
    for (const auto& [id, reached] : reached_) {
      place.landmarks.push_back(id);
      place.costs.push_back(weight * reached.travel_m);
    }
    return place;
  }
  [[nodiscard]] double travel_m(LandmarkId id) const { return reached_.at(id).travel_m; }
  [[nodiscard]] std::size_t goal(LandmarkId id) const { return reached_.at(id).goal; }
  [[nodiscard]] bool empty() const { return reached_.empty(); }

 private:
  struct Reached {
    double travel_m = 0.0;
    std::size_t goal = 0;
  };
  std::map<LandmarkId, Reached> reached_;
};

class Joiner {
 public:
  explicit Joiner(const SymbolicQuery& query) : query_(query) {}

  [[nodiscard]] End start() const {
    End end;
    if (query_.start.landmark != 0)
      end.add(query_.start.landmark, 0.0, 0);
    else
      join(query_.travel_from_start, 0, end);
    return end;
  }
  [[nodiscard]] End goals() const {
    End end;
    for (std::size_t i = 0; i < query_.goals.size(); ++i) {
      const GoalPlace& goal = query_.goals[i];
      if (goal.landmark != 0)
        end.add(goal.landmark, 0.0, i);
      else
        join(query_.start.space->travel_at_most(goal.pose.position(), query_.radius_m), i, end);
    }
    return end;
  }

 private:
  // Every landmark that has routes and that travel reaches.
  void join(const TravelField& travel, std::size_t goal, End& end) const {
    const DiscSpace& space = *query_.start.space;
    const LandmarkGraph& graph = query_.world.graph;
    const auto reached = [&](const Point& p) { return travel.reaches(space.field().cell_at(p)); };
    for (const auto& [id, landmark] : graph.landmarks()) {
      if (graph.routes_from(id).empty() && graph.routes_to(id).empty()) continue;
      const auto stand = standing_place(space, landmark, query_.radius_m, reached);
      if (stand) end.add(id, travel.cost_m(space.field().cell_at(stand->position())), goal);
    }
  }

  const SymbolicQuery& query_;
};

}  // namespace

SymbolicAnswer symbolic_path(const SymbolicQuery& query, const std::set<RouteId>& blocked, const Planner& graph_planner,
                             const Budget& budget) {
  SymbolicAnswer answer;
  if (query.world.graph.routes().empty()) return answer;
  const Joiner joiner(query);
  const End start = joiner.start();
  const End goals = joiner.goals();
  if (start.empty() || goals.empty()) return answer;
  PlanRequest request = query.request;
  // Travel off the routes in the unit that these are counted in.
  const double weight =
      request.cost == CostKind::time ? query.travel_weight / query.world.robot.max_v_mps : query.travel_weight;
  request.from = start.place(weight);
  request.to = goals.place(weight);
  request.closed.insert(request.closed.end(), blocked.begin(), blocked.end());
  const PlanResult found = graph_planner.plan(request, query.world, budget);
  answer.settled = found.settled;
  answer.alternatives = found.alternatives;
  answer.explanation = found.explanation;
  if (found.outcome == PlanOutcome::cancelled || found.outcome == PlanOutcome::out_of_budget)
    answer.stopped = found.outcome;
  if (found.outcome != PlanOutcome::solved || found.routes.empty()) return answer;
  SymbolicPath path{found.landmarks, found.routes, 0.0, goals.goal(found.landmarks.back())};
  path.cost_m = start.travel_m(found.landmarks.front()) + goals.travel_m(found.landmarks.back());
  for (const RouteId id : found.routes) path.cost_m += query.world.graph.find_route(id)->cost_m;
  answer.path = std::move(path);
  return answer;
}

}  // namespace cairn
