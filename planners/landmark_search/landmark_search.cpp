#include "planners/landmark_search/landmark_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "maps/base/text.hpp"
#include "maps/hierarchy/hierarchies.hpp"
#include "planners/landmark_search/alternatives.hpp"
#include "planners/landmark_search/answers.hpp"
#include "planners/landmark_search/explain.hpp"

namespace cairn {
namespace {

// The hierarchy that the world offers, or the graph as it is.
class Searched {
 public:
  Searched(const RouteRequest& request, const WorldView& world) {
    cost_ = route_cost(request.cost, {world.robot.max_v_mps, world.robot.max_w_radps, request.radius_m, &world.grid});
    if (world.hierarchies != nullptr) {
      hierarchy_ = &world.hierarchies->by(request.cost);
    } else {
      hierarchy_ = &own_.emplace(world.graph, ClusterTree{}, cost_, ClusterRules{no_clusters(), {}});
    }
  }
  [[nodiscard]] const Hierarchy& hierarchy() const { return *hierarchy_; }
  [[nodiscard]] const RouteCost& cost() const { return cost_; }

 private:
  RouteCost cost_;
  std::optional<Hierarchy> own_;
  const Hierarchy* hierarchy_ = nullptr;
};

std::vector<SearchEnd> ends_of(const std::vector<RouteEnd>& asked, const Network& network) {
  std::vector<SearchEnd> ends;
  for (const RouteEnd& end : asked) {
    const VertexIndex v = network.vertex_of(end.landmark);
    if (v == kNoVertex)
      throw std::logic_error(fmt::format(
          "landmark_search: the hierarchies lack L{}; they were not updated after the graph", end.landmark));
    ends.push_back({v, end.cost});
  }
  std::sort(ends.begin(), ends.end(), [](const SearchEnd& a, const SearchEnd& b) { return a.vertex < b.vertex; });
  return ends;
}

RouteQuery query_of(const RouteRequest& request, const Network& network) {
  RouteQuery query;
  query.from = ends_of(request.from, network);
  query.to = ends_of(request.to, network);
  for (const LandmarkId id : request.avoid)
    if (const VertexIndex v = network.vertex_of(id); v != kNoVertex) query.avoided.insert(v);
  for (const RouteId id : request.closed) query.costs[id] = kNoRoute;
  return query;
}

std::vector<LandmarkId> landmarks_of(const GraphPath& path, const Network& network) {
  std::vector<LandmarkId> landmarks;
  landmarks.reserve(path.vertices.size());
  for (const VertexIndex v : path.vertices) landmarks.push_back(network.landmark_of(v));
  return landmarks;
}

RouteResult search_graph(const RouteRequest& request, const WorldView& world, GraphSearch& search,
                         const Budget& budget) {
  RouteResult result;
  result.outcome = PlanOutcome::unknown_place;
  result.reason = complaint_about(request, world.graph);
  if (!result.reason.empty()) return result;
  if (budget.exhausted() || budget.iterations <= 0) return stopped_search(budget);

  const Searched searched(request, world);
  const Network& network = searched.hierarchy().network();
  const RouteQuery query = query_of(request, network);
  const GraphPath path = search.find(searched.hierarchy(), query, budget);
  if (path.stopped) return stopped_search(budget);
  result.settled = path.settled;
  if (request.explain)
    result.explanation =
        explanation_of(path, query, request, world.graph, searched.hierarchy(), searched.cost(), search, budget);
  if (!(path.cost < kNoRoute)) {
    result.outcome = PlanOutcome::no_route;
    result.reason = no_route_text(request, world.graph);
    if (result.explanation && result.explanation->cost_with_closed_open)
      result.reason += "; with every closed route open one would";
    return result;
  }
  result.outcome = PlanOutcome::solved;
  result.landmarks = landmarks_of(path, network);
  result.routes = path.routes;
  result.reason = by_routes_text(result.routes.size());
  for (const GraphPath& other :
       alternatives_to(path, request.alternatives, searched.hierarchy(), query, search, budget))
    result.alternatives.push_back({0.0, landmarks_of(other, network), other.routes});
  return result;
}

}  // namespace

std::unique_ptr<LandmarkSearch::Searches> LandmarkSearch::borrow() const {
  const std::scoped_lock lock(idle_lock_);
  if (idle_.empty()) return std::make_unique<Searches>();
  std::unique_ptr<Searches> searches = std::move(idle_.back());
  idle_.pop_back();
  return searches;
}

void LandmarkSearch::give_back(std::unique_ptr<Searches> searches) const {
  const std::scoped_lock lock(idle_lock_);
  idle_.push_back(std::move(searches));
}

bool LandmarkSearch::is_for_boost(const LandmarkGraph& graph) const {
  return graph.landmarks().size() < static_cast<std::size_t>(config_.bidirectional_from);
}

void LandmarkSearch::name_search(const RouteRequest& request, const LandmarkGraph& graph,
                                 RouteExplanation& explanation) const {
  const bool boost = is_for_boost(graph);
  explanation.search = boost ? "Boost.Graph's A*" : "the search from both ends";
  explanation.search_reason =
      fmt::format("{}, {} bidirectional_from ({})", counted(graph.landmarks().size(), "landmark"),
                  boost ? "fewer than" : "not fewer than", config_.bidirectional_from);
  if (request.alternatives > 0) explanation.search_reason += "; alternatives by Yen's method over the same search";
  for (std::size_t level = 0; level < explanation.settled_of_level.size(); ++level)
    if (explanation.settled_of_level[level] > 0) explanation.search_level = static_cast<int>(level);
}

RouteResult LandmarkSearch::plan(const RouteRequest& request, const WorldView& world, const Budget& budget) const {
  std::unique_ptr<Searches> searches = borrow();
  GraphSearch& search = is_for_boost(world.graph) ? static_cast<GraphSearch&>(searches->boost)
                                                  : static_cast<GraphSearch&>(searches->bidirectional);
  RouteResult result = search_graph(request, world, search, budget);
  give_back(std::move(searches));
  if (result.explanation) name_search(request, world.graph, *result.explanation);
  if (result.outcome == PlanOutcome::solved)
    result.cost_m = cost_m_of(result.landmarks, result.routes, request, world.graph);
  for (RouteAlternative& other : result.alternatives)
    other.cost_m = cost_m_of(other.landmarks, other.routes, request, world.graph);
  return result;
}

}  // namespace cairn
