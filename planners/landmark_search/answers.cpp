#include "planners/landmark_search/answers.hpp"

#include <algorithm>
#include <chrono>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

// A landmark id of the request that the graph does not hold, or 0.
LandmarkId unknown_of(const std::vector<LandmarkId>& wanted, const LandmarkGraph& graph) {
  for (const LandmarkId id : wanted)
    if (graph.find(id) == nullptr) return id;
  return 0;
}

std::string complaint_about_end(const Place& place, const LandmarkGraph& graph, const std::string& end) {
  if (place.pose) return "the " + end + " is a pose, and a search over the landmark graph needs landmarks";
  if (place.landmarks.empty()) return "the request names no " + end;
  if (const LandmarkId id = unknown_of(place.landmarks, graph))
    return "the map has no landmark L" + std::to_string(id) + " (" + end + ")";
  if (!place.costs.empty() && place.costs.size() != place.landmarks.size())
    return "the request gives " + std::to_string(place.costs.size()) + " costs for " +
           std::to_string(place.landmarks.size()) + " landmarks (" + end + ")";
  return {};
}

std::string labels_of(const std::vector<LandmarkId>& ids, const LandmarkGraph& graph) {
  std::string text = label_of(*graph.find(ids.front()));
  if (ids.size() > 1) text += " or " + std::to_string(ids.size() - 1) + " more";
  return text;
}

Pose2 standing_at(const Landmark& landmark) {
  return landmark.access.value_or(landmark.T_map_landmark);
}

void append_trajectory(std::vector<Pose2>& path, const Route* route, const Landmark& at) {
  const std::vector<Pose2> alone{standing_at(at)};
  for (const Pose2& pose : route != nullptr && !route->trajectory.empty() ? route->trajectory : alone)
    if (path.empty() || !(path.back() == pose)) path.push_back(pose);
}

double cost_of_end(const Place& place, LandmarkId id) {
  const auto at = std::find(place.landmarks.begin(), place.landmarks.end(), id);
  return place.costs.empty() ? 0.0 : place.costs[static_cast<std::size_t>(at - place.landmarks.begin())];
}

}  // namespace

std::string complaint_about(const PlanRequest& request, const LandmarkGraph& graph) {
  const std::string complaint = complaint_about_end(request.from, graph, "start");
  return complaint.empty() ? complaint_about_end(request.to, graph, "goal") : complaint;
}

PlanResult stopped_search(const Budget& budget) {
  PlanResult result;
  result.outcome = budget.cancelled() ? PlanOutcome::cancelled : PlanOutcome::out_of_budget;
  result.reason = budget.cancelled() ? "the search was cancelled"
                                     : "the budget was used up before the search over the landmark graph ended";
  return result;
}

std::string no_route_text(const PlanRequest& request, const LandmarkGraph& graph) {
  std::string reason = "no open route leads from " + labels_of(request.from.landmarks, graph) + " to " +
                       labels_of(request.to.landmarks, graph);
  if (!request.avoid.empty()) reason += " past what is to be avoided";
  return reason;
}

std::string by_routes_text(std::size_t routes) {
  return "by " + std::to_string(routes) + " stored route" + (routes == 1 ? "" : "s");
}

double cost_m_of(const std::vector<LandmarkId>& landmarks, const std::vector<RouteId>& routes,
                 const PlanRequest& request, const LandmarkGraph& graph) {
  double cost_m = 0.0;
  for (const RouteId id : routes) cost_m += graph.find_route(id)->cost_m;
  if (request.cost != CostKind::length) return cost_m;
  return cost_of_end(request.from, landmarks.front()) + cost_m + cost_of_end(request.to, landmarks.back());
}

void join_trajectories(PlanResult& result, const LandmarkGraph& graph) {
  const auto route_at = [&](std::size_t i) { return graph.find_route(result.routes[i]); };
  if (result.routes.empty() || route_at(0)->trajectory.empty())
    append_trajectory(result.path, nullptr, *graph.find(result.landmarks.front()));
  for (std::size_t i = 0; i < result.routes.size(); ++i)
    append_trajectory(result.path, route_at(i), *graph.find(result.landmarks[i + 1]));
  result.length_m = length_of(result.path);
}

double ms_between(Budget::Clock::time_point begin, Budget::Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

}  // namespace cairn
