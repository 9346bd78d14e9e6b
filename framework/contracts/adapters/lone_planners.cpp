#include "framework/contracts/adapters/lone_planners.hpp"

#include <chrono>

namespace cairn {
namespace {

using Time = Budget::Clock::time_point;

double ms_between(Time begin, Time end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

std::vector<RouteEnd> ends_of(const Place& place) {
  std::vector<RouteEnd> ends;
  for (const LandmarkId id : place.landmarks) ends.push_back({id, 0.0});
  return ends;
}

void append_trajectory(std::vector<Pose2>& path, const Route* route, const Landmark& at) {
  const std::vector<Pose2> alone{at.access.value_or(at.T_map_landmark)};
  for (const Pose2& pose : route != nullptr && !route->trajectory.empty() ? route->trajectory : alone)
    if (path.empty() || !(path.back() == pose)) path.push_back(pose);
}

// Fills path and length_m from landmarks and routes.
void join_trajectories(PlanResult& result, const LandmarkGraph& graph) {
  const auto route_at = [&](std::size_t i) { return graph.find_route(result.routes[i]); };
  if (result.routes.empty() || route_at(0)->trajectory.empty())
    append_trajectory(result.path, nullptr, *graph.find(result.landmarks.front()));
  for (std::size_t i = 0; i < result.routes.size(); ++i)
    append_trajectory(result.path, route_at(i), *graph.find(result.landmarks[i + 1]));
  for (std::size_t i = 1; i < result.path.size(); ++i)
    result.length_m += (result.path[i].position() - result.path[i - 1].position()).norm();
}

PlanResult not_a_landmark(const std::string& end) {
  PlanResult result;
  result.outcome = PlanOutcome::unsupported;
  result.reason = "the " + end + " is a pose, and a search over the landmark graph needs landmarks";
  return result;
}

PlanResult not_on_the_grid(const std::string& what) {
  PlanResult result;
  result.outcome = PlanOutcome::unsupported;
  result.reason = what + " of the landmark graph, and this planner plans on the grid alone; hybrid does both";
  return result;
}

}  // namespace

PathRequest path_request_of(const PlanRequest& request) {
  return {request.from, request.to, request.radius_m, request.seed, request.cost, request.speed_mps};
}

RouteRequest route_request_of(const PlanRequest& request) {
  return {ends_of(request.from), ends_of(request.to), request.radius_m,     request.cost,
          request.avoid,         request.closed,      request.alternatives, request.explain};
}

PlanResult plan_of(PathResult&& found) {
  PlanResult result;
  result.outcome = found.outcome;
  result.reason = std::move(found.reason);
  result.cost_m = found.cost_m;
  result.length_m = found.length_m;
  result.clearance_m = found.clearance_m;
  for (const LandmarkId id : {found.from_landmark, found.to_landmark})
    if (id != 0 && (result.landmarks.empty() || result.landmarks.back() != id)) result.landmarks.push_back(id);
  result.path = std::move(found.path);
  result.length_lower_bound_m = found.length_lower_bound_m;
  result.driving_time_s = found.driving_time_s;
  return result;
}

PlanResult LonePathPlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  if (request.alternatives > 0) return not_on_the_grid("alternatives are routes");
  if (!request.avoid.empty()) return not_on_the_grid("what is to be avoided are landmarks");
  const Time begin = Budget::Clock::now();
  PlanResult result = plan_of(paths_->plan(path_request_of(request), world, budget));
  if (result.outcome == PlanOutcome::solved) result.segments = {{PathSegment::Origin::planned, 0, result.length_m}};
  result.time_ms.route_ms = ms_between(begin, Budget::Clock::now());
  result.time_ms.total_ms = result.time_ms.route_ms;
  return result;
}

PlanResult LoneRoutePlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  if (request.from.pose) return not_a_landmark("start");
  if (request.to.pose) return not_a_landmark("goal");
  const Time begin = Budget::Clock::now();
  RouteResult found = routes_->plan(route_request_of(request), world, budget);
  const Time end = Budget::Clock::now();
  PlanResult result;
  result.outcome = found.outcome;
  result.reason = std::move(found.reason);
  result.cost_m = found.cost_m;
  result.landmarks = std::move(found.landmarks);
  result.routes = std::move(found.routes);
  result.settled = found.settled;
  result.alternatives = std::move(found.alternatives);
  result.explanation = std::move(found.explanation);
  if (result.outcome == PlanOutcome::solved) join_trajectories(result, world.graph);
  result.time_ms = {ms_between(begin, end), ms_between(end, Budget::Clock::now()),
                    ms_between(begin, Budget::Clock::now())};
  return result;
}

}  // namespace cairn
