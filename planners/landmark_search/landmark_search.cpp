#include "planners/landmark_search/landmark_search.hpp"

#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <chrono>
#include <functional>
#include <limits>

#include "planners/landmark_search/boost_landmark_graph.hpp"

namespace cairn {
namespace {

using Graph = BoostLandmarkGraph::Graph;
using Edge = boost::graph_traits<Graph>::edge_descriptor;

constexpr std::int64_t kSettledPerBudgetCheck = 256;

struct Search {
  std::vector<bool> is_goal;
  std::vector<double> cost_m;
  std::vector<const Route*> arrived_by;
  std::size_t goal = BoostLandmarkGraph::kNone;
  std::int64_t settled = 0;
  bool cut_short = false;
};

struct Stop {};

// Ends the search at the first goal that is settled, or when the budget is used up.
class EarlyStop : public boost::default_dijkstra_visitor {
 public:
  EarlyStop(Search& search, const Budget& budget) : search_(&search), budget_(&budget) {}

  void examine_vertex(std::size_t vertex, const Graph&) {
    const bool look = search_->settled % kSettledPerBudgetCheck == 0;
    if (search_->settled >= budget_->iterations || (look && budget_->exhausted())) {
      search_->cut_short = true;
      throw Stop{};
    }
    ++search_->settled;
    if (search_->is_goal[vertex]) {
      search_->goal = vertex;
      throw Stop{};
    }
  }
  void edge_relaxed(const Edge& edge, const Graph& graph) {
    search_->arrived_by[target(edge, graph)] = graph[edge].route;
  }

 private:
  Search* search_;
  const Budget* budget_;
};

// A landmark id of the request that the graph does not hold, or 0.
LandmarkId unknown_of(const std::vector<LandmarkId>& wanted, const LandmarkGraph& graph) {
  for (const LandmarkId id : wanted)
    if (graph.find(id) == nullptr) return id;
  return 0;
}

std::string complaint_about(const Place& place, const LandmarkGraph& graph, const std::string& end) {
  if (place.pose) return "the " + end + " is a pose, and a search over the landmark graph needs landmarks";
  if (place.landmarks.empty()) return "the request names no " + end;
  if (const LandmarkId id = unknown_of(place.landmarks, graph))
    return "the map has no landmark L" + std::to_string(id) + " (" + end + ")";
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

// Dijkstra from all sources at once.
Search search_from(const BoostLandmarkGraph& model, const std::vector<std::size_t>& sources,
                   const std::vector<bool>& is_goal, const Budget& budget) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Search search;
  search.is_goal = is_goal;
  search.cost_m.assign(model.ids.size(), kInfinity);
  search.arrived_by.assign(model.ids.size(), nullptr);
  for (const std::size_t source : sources) search.cost_m[source] = 0.0;
  const auto index = boost::get(boost::vertex_index, model.graph);
  std::vector<boost::default_color_type> colour(model.ids.size(), boost::white_color);
  try {
    boost::dijkstra_shortest_paths_no_init(model.graph, sources.begin(), sources.end(), boost::dummy_property_map(),
                                           boost::make_iterator_property_map(search.cost_m.begin(), index),
                                           boost::get(&RouteEdge::cost_m, model.graph), index, std::less<>(),
                                           std::plus<>(), 0.0, EarlyStop(search, budget),
                                           boost::make_iterator_property_map(colour.begin(), index));
  } catch (const Stop&) {
  }
  return search;
}

void append_trajectory(std::vector<Pose2>& path, const Route* route, const Landmark& at) {
  const std::vector<Pose2> alone{standing_at(at)};
  for (const Pose2& pose : route != nullptr && !route->trajectory.empty() ? route->trajectory : alone)
    if (path.empty() || !(path.back() == pose)) path.push_back(pose);
}

void fill_path(PlanResult& result, const Search& search, const BoostLandmarkGraph& model, const LandmarkGraph& graph) {
  std::vector<const Route*> routes;
  LandmarkId at = model.ids[search.goal];
  for (std::size_t v = search.goal; search.arrived_by[v] != nullptr; v = model.vertex_of(at)) {
    routes.push_back(search.arrived_by[v]);
    at = search.arrived_by[v]->from;
  }
  std::reverse(routes.begin(), routes.end());
  result.landmarks = {at};
  if (routes.empty() || routes.front()->trajectory.empty()) append_trajectory(result.path, nullptr, *graph.find(at));
  for (const Route* route : routes) {
    result.landmarks.push_back(route->to);
    result.routes.push_back(route->id);
    append_trajectory(result.path, route, *graph.find(route->to));
  }
  result.cost_m = search.cost_m[search.goal];
  for (std::size_t i = 1; i < result.path.size(); ++i)
    result.length_m += (result.path[i].position() - result.path[i - 1].position()).norm();
}

PlanResult stopped(const Budget& budget) {
  PlanResult result;
  result.outcome = budget.cancelled() ? PlanOutcome::cancelled : PlanOutcome::out_of_budget;
  result.reason = budget.cancelled() ? "the search was cancelled"
                                     : "the budget was used up before the search over the landmark graph ended";
  return result;
}

PlanResult search_graph(const PlanRequest& request, const LandmarkGraph& graph, const Budget& budget) {
  PlanResult result;
  result.outcome = PlanOutcome::unknown_place;
  result.reason = complaint_about(request.from, graph, "start");
  if (result.reason.empty()) result.reason = complaint_about(request.to, graph, "goal");
  if (!result.reason.empty()) return result;
  if (budget.exhausted() || budget.iterations <= 0) return stopped(budget);

  const BoostLandmarkGraph model(graph);
  std::vector<bool> is_goal(model.ids.size(), false);
  for (const LandmarkId id : request.to.landmarks) is_goal[model.vertex_of(id)] = true;
  std::vector<std::size_t> sources;
  for (const LandmarkId id : request.from.landmarks) sources.push_back(model.vertex_of(id));
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  const Search search = search_from(model, sources, is_goal, budget);
  if (search.cut_short) return stopped(budget);
  result.settled = search.settled;
  if (search.goal == BoostLandmarkGraph::kNone) {
    result.outcome = PlanOutcome::no_route;
    result.reason = "no open route leads from " + labels_of(request.from.landmarks, graph) + " to " +
                    labels_of(request.to.landmarks, graph);
    return result;
  }
  result.outcome = PlanOutcome::solved;
  fill_path(result, search, model, graph);
  result.reason =
      "by " + std::to_string(result.routes.size()) + " stored route" + (result.routes.size() == 1 ? "" : "s");
  return result;
}

}  // namespace

PlanResult LandmarkSearch::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  const auto begin = Budget::Clock::now();
  PlanResult result = search_graph(request, world.graph, budget);
  result.time_ms.graph_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  result.time_ms.total_ms = result.time_ms.graph_ms;
  return result;
}

}  // namespace cairn
