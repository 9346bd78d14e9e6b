#include "tests/planners/landmark_search/way_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace cairn::test {
namespace {

double cost_of(const Route& route, const Question& question) {
  if (const auto found = question.costs.find(route.id); found != question.costs.end()) return found->second;
  return route.closed ? kNoRoute : route.cost_m;
}

template <class Map>
auto any_key(const Map& map, std::mt19937_64& random) {
  const auto end = static_cast<std::uint64_t>(map.rbegin()->first) + 1;
  const auto at = map.lower_bound(static_cast<typename Map::key_type>(random() % end));
  return at->first;
}

// Tries every path on from a landmark, depth first.
class Enumeration {
 public:
  Enumeration(const LandmarkGraph& graph, const Question& question) : graph_(graph), question_(question) {}

  std::vector<double> all() {
    for (const auto& [start, cost] : question_.from) go_on(start, cost);
    std::sort(costs_.begin(), costs_.end());
    return costs_;
  }

 private:
  void go_on(LandmarkId at, double cost) {
    if (const auto goal = question_.to.find(at); goal != question_.to.end()) costs_.push_back(cost + goal->second);
    if (!passed_.empty() && question_.avoided.contains(at)) return;
    passed_.insert(at);
    for (const RouteId id : graph_.routes_from(at)) {
      const Route& route = *graph_.find_route(id);
      const double on = cost_of(route, question_);
      if (on < kNoRoute && !passed_.contains(route.to)) go_on(route.to, cost + on);
    }
    passed_.erase(at);
  }

  const LandmarkGraph& graph_;
  const Question& question_;
  std::set<LandmarkId> passed_;
  std::vector<double> costs_;
};

}  // namespace

bool same_cost(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(a));
}

RouteQuery query_of(const Question& question, const Network& network) {
  RouteQuery query;
  for (const auto& [id, cost] : question.from) query.from.push_back({network.vertex_of(id), cost});
  for (const auto& [id, cost] : question.to) query.to.push_back({network.vertex_of(id), cost});
  for (const LandmarkId id : question.avoided) query.avoided.insert(network.vertex_of(id));
  query.costs.insert(question.costs.begin(), question.costs.end());
  return query;
}

Question random_question(const LandmarkGraph& graph, const Variety& variety, std::mt19937_64& random) {
  Question question;
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<std::uint64_t>(end)); };
  const auto end_cost = [&] { return variety.end_costs ? static_cast<double>(below(30)) : 0.0; };
  for (auto* ends : {&question.from, &question.to})
    for (int i = below(variety.max_ends); i >= 0; --i) (*ends)[any_key(graph.landmarks(), random)] = end_cost();
  for (int i = below(variety.max_avoided + 1); i > 0; --i) switch (below(4)) {
      case 0:
        question.avoided.insert(any_key(question.from, random));
        break;
      case 1:
        question.avoided.insert(any_key(question.to, random));
        break;
      default:
        question.avoided.insert(any_key(graph.landmarks(), random));
    }
  if (graph.routes().empty()) return question;
  for (int i = below(variety.max_costs + 1); i > 0; --i)
    question.costs[any_key(graph.routes(), random)] = below(2) == 0 ? kNoRoute : static_cast<double>(below(5));
  return question;
}

double cheapest(const LandmarkGraph& graph, const Question& question) {
  // A landmark as a start may be left even when it is avoided: it counts as another one.
  using State = std::pair<LandmarkId, bool>;
  std::map<State, double> costs;
  std::priority_queue<std::tuple<double, LandmarkId, bool>, std::vector<std::tuple<double, LandmarkId, bool>>,
                      std::greater<>>
      queue;
  const auto reach = [&](const State& state, double cost) {
    const auto [at, fresh] = costs.emplace(state, cost);
    if (!fresh && !(cost < at->second)) return;
    at->second = cost;
    queue.emplace(cost, state.first, state.second);
  };
  for (const auto& [id, cost] : question.from) reach({id, true}, cost);
  double best = kNoRoute;
  while (!queue.empty()) {
    const auto [cost, id, is_start] = queue.top();
    queue.pop();
    if (cost > costs.at({id, is_start})) continue;
    if (const auto goal = question.to.find(id); goal != question.to.end()) best = std::min(best, cost + goal->second);
    if (!is_start && question.avoided.contains(id)) continue;
    for (const RouteId r : graph.routes_from(id)) {
      const Route& route = *graph.find_route(r);
      if (const double on = cost_of(route, question); on < kNoRoute) reach({route.to, false}, cost + on);
    }
  }
  return best;
}

std::vector<double> all_costs(const LandmarkGraph& graph, const Question& question) {
  return Enumeration(graph, question).all();
}

std::string fault_of(const GraphPath& path, const Question& question, const LandmarkGraph& graph,
                     const Network& network) {
  if (!(path.cost < kNoRoute)) return path.vertices.empty() && path.routes.empty() ? "" : "a path without a cost";
  std::vector<LandmarkId> landmarks;
  for (const VertexIndex v : path.vertices) landmarks.push_back(network.landmark_of(v));
  if (landmarks.empty() || path.routes.size() + 1 != landmarks.size()) return "landmarks and routes do not alternate";
  if (!question.from.contains(landmarks.front())) return "begins at L" + std::to_string(landmarks.front());
  if (!question.to.contains(landmarks.back())) return "ends at L" + std::to_string(landmarks.back());
  if (std::set(landmarks.begin(), landmarks.end()).size() != landmarks.size()) return "passes a landmark twice";
  double sum = question.from.at(landmarks.front()) + question.to.at(landmarks.back());
  for (std::size_t i = 0; i < path.routes.size(); ++i) {
    const Route* const route = graph.find_route(path.routes[i]);
    if (route == nullptr || route->from != landmarks[i] || route->to != landmarks[i + 1])
      return "route " + std::to_string(path.routes[i]) + " does not join its landmarks";
    if (i > 0 && question.avoided.contains(landmarks[i])) return "passes L" + std::to_string(landmarks[i]);
    sum += cost_of(*route, question);
  }
  return same_cost(sum, path.cost) ? "" : "its routes cost " + std::to_string(sum);
}

}  // namespace cairn::test
