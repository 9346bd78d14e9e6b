#include "planners/landmark_search/answers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

std::string complaint_about_end(const std::vector<RouteEnd>& ends, const LandmarkGraph& graph,
                                const std::string& name) {
  if (ends.empty()) return "the request names no " + name;
  for (const RouteEnd& end : ends)
    if (graph.find(end.landmark) == nullptr) return fmt::format("the map has no landmark L{} ({})", end.landmark, name);
  return {};
}

std::string labels_of(const std::vector<RouteEnd>& ends, const LandmarkGraph& graph) {
  std::string text = label_of(*graph.find(ends.front().landmark));
  if (ends.size() > 1) text += fmt::format(" or {} more", ends.size() - 1);
  return text;
}

double cost_of_end(const std::vector<RouteEnd>& ends, LandmarkId id) {
  return std::ranges::find(ends, id, &RouteEnd::landmark)->cost;
}

}  // namespace

std::string complaint_about(const RouteRequest& request, const LandmarkGraph& graph) {
  const std::string complaint = complaint_about_end(request.from, graph, "start");
  return complaint.empty() ? complaint_about_end(request.to, graph, "goal") : complaint;
}

RouteResult stopped_search(const Budget& budget) {
  RouteResult result;
  result.outcome = budget.cancelled() ? PlanOutcome::cancelled : PlanOutcome::out_of_budget;
  result.reason = budget.cancelled() ? "the search was cancelled"
                                     : "the budget was used up before the search over the landmark graph ended";
  return result;
}

std::string no_route_text(const RouteRequest& request, const LandmarkGraph& graph) {
  std::string reason =
      "no open route leads from " + labels_of(request.from, graph) + " to " + labels_of(request.to, graph);
  if (!request.avoid.empty()) reason += " past what is to be avoided";
  return reason;
}

std::string by_routes_text(std::size_t routes) {
  return "by " + counted(routes, "stored route");
}

double cost_m_of(const std::vector<LandmarkId>& landmarks, const std::vector<RouteId>& routes,
                 const RouteRequest& request, const LandmarkGraph& graph) {
  double cost_m = 0.0;
  for (const RouteId id : routes) cost_m += graph.find_route(id)->cost_m;
  if (request.cost != CostKind::length) return cost_m;
  return cost_of_end(request.from, landmarks.front()) + cost_m + cost_of_end(request.to, landmarks.back());
}

}  // namespace cairn
