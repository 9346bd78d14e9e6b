#include "planners/hybrid/symbolic_path.hpp"

#include <algorithm>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "maps/hierarchy/hierarchies.hpp"

namespace cairn {
namespace {

// Of level 1, in a small graph; kNoCluster where there is none.
ClusterIndex cluster_of(LandmarkId id, const WorldView& world) {
  if (world.hierarchies == nullptr) return kNoCluster;
  const Hierarchy& hierarchy = world.hierarchies->by(CostKind::length);
  if (!hierarchy.clustering().is_small()) return kNoCluster;
  return hierarchy.clustering().leaf_of(hierarchy.network().vertex_of(id));
}

class Joiner {
 public:
  Joiner(const SymbolicQuery& query, const Budget& budget) : query_(query), budget_(budget) {}

  [[nodiscard]] SymbolicEnd start() const {
    SymbolicEnd end;
    if (query_.start.landmark != 0)
      end.add(query_.start.landmark, 0.0, 0);
    else
      join(query_.start.space->travel_at_most(query_.start.leave_from, query_.radius_m), 0, end);
    return end;
  }
  [[nodiscard]] SymbolicEnd goals() const {
    SymbolicEnd end;
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
  // Landmarks that have routes and that travel reaches: those of the cluster that the nearest of them is in, or all.
  void join(const TravelField& travel, std::size_t goal, SymbolicEnd& end) const {
    const DiscSpace& space = *query_.start.space;
    const LandmarkGraph& graph = query_.world.graph;
    std::vector<std::pair<double, LandmarkId>> joined;
    const auto reached = [&](const Point& p) { return travel.reaches(space.field().cell_at(p)); };
    for (const auto& [id, landmark] : graph.landmarks()) {
      if (budget_.exhausted()) return;  // which the search then says
      if (graph.routes_from(id).empty() && graph.routes_to(id).empty()) continue;
      const auto approach = approach_pose(space, landmark, query_.radius_m, reached);
      if (approach) joined.emplace_back(travel.cost_m(space.field().cell_at(approach->position())), id);
    }
    const ClusterIndex cluster =
        joined.empty() ? kNoCluster : cluster_of(std::ranges::min(joined).second, query_.world);
    for (const auto& [travel_m, id] : joined)
      if (cluster == kNoCluster || cluster_of(id, query_.world) == cluster) end.add(id, travel_m, goal);
  }

  const SymbolicQuery& query_;
  const Budget& budget_;
};

}  // namespace

void SymbolicEnd::add(LandmarkId id, double travel_m, std::size_t goal) {
  const auto [at, fresh] = reached_.emplace(id, Reached{travel_m, goal});
  if (!fresh && travel_m < at->second.travel_m) at->second = {travel_m, goal};
}

std::vector<RouteEnd> SymbolicEnd::route_ends(double weight) const {
  std::vector<RouteEnd> ends;
  for (const auto& [id, reached] : reached_) ends.push_back({id, weight * reached.travel_m});
  return ends;
}

SymbolicSearch::SymbolicSearch(const SymbolicQuery& query, const RoutePlanner& route_planner, const Budget& budget)
    : query_(query), route_planner_(route_planner), budget_(budget) {
  if (query.world.graph.routes().empty()) return;
  const Joiner joiner(query, budget);
  start_ = joiner.start();
  goals_ = joiner.goals();
}

SymbolicAnswer SymbolicSearch::find(const std::set<RouteId>& blocked) const {
  SymbolicAnswer answer;
  if (budget_.exhausted()) answer.stopped = stop_outcome(budget_);
  if (answer.stopped || start_.empty() || goals_.empty()) return answer;
  RouteRequest request = route_request_of(query_.request);
  // Travel off the routes in the unit that these are counted in.
  const double weight =
      request.cost == CostKind::time ? query_.travel_weight / query_.world.robot.max_v_mps : query_.travel_weight;
  request.from = start_.route_ends(weight);
  request.to = goals_.route_ends(weight);
  request.closed.insert(request.closed.end(), blocked.begin(), blocked.end());
  const RouteResult found = route_planner_.plan(request, query_.world, budget_);
  answer.settled = found.settled;
  answer.explanation = found.explanation;
  if (found.outcome == PlanOutcome::cancelled || found.outcome == PlanOutcome::out_of_budget)
    answer.stopped = found.outcome;
  if (found.outcome == PlanOutcome::solved && !found.routes.empty()) {
    SymbolicPath path{found.landmarks, found.routes, 0.0, goals_.goal(found.landmarks.back())};
    path.cost_m = start_.travel_m(found.landmarks.front()) + goals_.travel_m(found.landmarks.back());
    for (const RouteId id : found.routes) path.cost_m += query_.world.graph.find_route(id)->cost_m;
    path.leaves_its_cluster =
        cluster_of(path.landmarks.front(), query_.world) != cluster_of(path.landmarks.back(), query_.world);
    answer.path = std::move(path);
    answer.candidates.push_back({found.cost_m, found.landmarks, found.routes});
  }
  answer.candidates.insert(answer.candidates.end(), found.alternatives.begin(), found.alternatives.end());
  return answer;
}

}  // namespace cairn
