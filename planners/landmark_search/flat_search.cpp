#include "planners/landmark_search/flat_search.hpp"

#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <functional>
#include <limits>

#include "planners/landmark_search/answers.hpp"
#include "planners/landmark_search/graphs/boost_landmark_graph.hpp"

namespace cairn {
namespace {

using Graph = BoostLandmarkGraph::Graph;
using Edge = boost::graph_traits<Graph>::edge_descriptor;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Search {
  std::vector<double> goal_cost_m;  // of going on from each vertex to the goal; infinite: it is none
  std::vector<double> cost_m;
  std::vector<const Route*> arrived_by;
  std::size_t goal = BoostLandmarkGraph::kNone;
  double best_m = kInfinity;
  std::int64_t settled = 0;
  bool cut_short = false;
};

struct Stop {};

// Ends the search when no further goal can be cheaper, or when the budget is used up.
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
    const double cost_m = search_->cost_m[vertex];
    if (cost_m + search_->goal_cost_m[vertex] < search_->best_m) {
      search_->best_m = cost_m + search_->goal_cost_m[vertex];
      search_->goal = vertex;
    }
    if (cost_m >= search_->best_m) throw Stop{};
  }
  void edge_relaxed(const Edge& edge, const Graph& graph) {
    search_->arrived_by[target(edge, graph)] = graph[edge].route;
  }

 private:
  Search* search_;
  const Budget* budget_;
};

// What each vertex costs as an end.
std::vector<double> costs_of(const std::vector<RouteEnd>& ends, const BoostLandmarkGraph& model) {
  std::vector<double> costs_m(model.ids.size(), kInfinity);
  for (const RouteEnd& end : ends) {
    double& cost_m = costs_m[model.vertex_of(end.landmark)];
    cost_m = std::min(cost_m, end.cost);
  }
  return costs_m;
}

// Dijkstra from all starts at once.
Search search_for(const RouteRequest& request, const BoostLandmarkGraph& model, const Budget& budget) {
  Search search;
  search.goal_cost_m = costs_of(request.to, model);
  search.cost_m = costs_of(request.from, model);
  search.arrived_by.assign(model.ids.size(), nullptr);
  std::vector<std::size_t> starts;
  for (std::size_t v = 0; v < model.ids.size(); ++v)
    if (search.cost_m[v] < kInfinity) starts.push_back(v);
  const auto index = boost::get(boost::vertex_index, model.graph);
  std::vector<boost::default_color_type> colour(model.ids.size(), boost::white_color);
  try {
    boost::dijkstra_shortest_paths_no_init(model.graph, starts.begin(), starts.end(), boost::dummy_property_map(),
                                           boost::make_iterator_property_map(search.cost_m.begin(), index),
                                           boost::get(&RouteEdge::cost_m, model.graph), index, std::less<>(),
                                           std::plus<>(), 0.0, EarlyStop(search, budget),
                                           boost::make_iterator_property_map(colour.begin(), index));
  } catch (const Stop&) {
  }
  return search;
}

// Landmarks and routes of the path to the goal.
void follow_back(const Search& search, const BoostLandmarkGraph& model, RouteResult& result) {
  result.landmarks = {model.ids[search.goal]};
  for (std::size_t v = search.goal; search.arrived_by[v] != nullptr; v = model.vertex_of(result.landmarks.back())) {
    result.routes.push_back(search.arrived_by[v]->id);
    result.landmarks.push_back(search.arrived_by[v]->from);
  }
  std::reverse(result.routes.begin(), result.routes.end());
  std::reverse(result.landmarks.begin(), result.landmarks.end());
}

// What the plain search does not support.
std::string unsupported(const RouteRequest& request) {
  if (request.cost != CostKind::length) return "other costs than length";
  if (request.alternatives > 0) return "alternatives";
  return request.explain ? "an explanation" : "";
}

RouteResult search_graph(const RouteRequest& request, const LandmarkGraph& graph, const Budget& budget) {
  RouteResult result;
  result.outcome = PlanOutcome::unknown_place;
  result.reason = complaint_about(request, graph);
  if (!result.reason.empty()) return result;
  if (const std::string what = unsupported(request); !what.empty()) {
    result.outcome = PlanOutcome::unsupported;
    result.reason = "flat_search does not know " + what + "; landmark_search does";
    return result;
  }
  if (budget.exhausted() || budget.iterations <= 0) return stopped_search(budget);

  const BoostLandmarkGraph model(graph, request);
  const Search search = search_for(request, model, budget);
  if (search.cut_short) return stopped_search(budget);
  result.settled = search.settled;
  if (search.goal == BoostLandmarkGraph::kNone) {
    result.outcome = PlanOutcome::no_route;
    result.reason = no_route_text(request, graph);
    return result;
  }
  result.outcome = PlanOutcome::solved;
  follow_back(search, model, result);
  result.cost_m = search.best_m;
  result.reason = by_routes_text(result.routes.size());
  return result;
}

}  // namespace

RouteResult FlatSearch::plan(const RouteRequest& request, const WorldView& world, const Budget& budget) const {
  return search_graph(request, world.graph, budget);
}

}  // namespace cairn
