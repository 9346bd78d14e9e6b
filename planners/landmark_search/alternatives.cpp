#include "planners/landmark_search/alternatives.hpp"

#include <algorithm>
#include <set>

namespace cairn {
namespace {

class Yen {
 public:
  Yen(const Hierarchy& hierarchy, const RouteQuery& query, GraphSearch& search, const Budget& budget)
      : hierarchy_(hierarchy), query_(query), search_(search), budget_(budget) {}

  std::vector<GraphPath> after(const GraphPath& best, int count) {
    taken_.push_back(best);
    while (static_cast<int>(taken_.size()) <= count) {
      leave(taken_.back());
      if (candidates_.empty() || budget_.exhausted()) break;
      const auto next =
          std::min_element(candidates_.begin(), candidates_.end(), [](const GraphPath& a, const GraphPath& b) {
            return a.cost != b.cost ? a.cost < b.cost : a.routes < b.routes;
          });
      taken_.push_back(std::move(*next));
      candidates_.erase(next);
    }
    taken_.erase(taken_.begin());
    return std::move(taken_);
  }

 private:
  double cost_of(RouteId route) const {
    if (const auto found = query_.costs.find(route); found != query_.costs.end()) return found->second;
    const auto [from, to] = hierarchy_.network().ends_of(route);
    for (const Arc& arc : hierarchy_.network().out(from))
      if (arc.route == route) return arc.cost;
    return kNoRoute;
  }
  double cost_of_start(VertexIndex v) const {
    double cost = kNoRoute;
    for (const SearchEnd& end : query_.from)
      if (end.vertex == v) cost = std::min(cost, end.cost);
    return cost;
  }

  // The paths that leave this one at each of its landmarks, or begin elsewhere.
  void leave(const GraphPath& path) {
    RouteQuery query = query_;
    begins_at_.insert(path.vertices.front());
    std::erase_if(query.from, [&](const SearchEnd& end) { return begins_at_.contains(end.vertex); });
    if (!query.from.empty()) add(path, 0, 0.0, search_.find(hierarchy_, query, budget_));
    std::vector<SearchEnd> goals = query_.to;  // without landmarks passed before
    query = query_;
    double root_cost = cost_of_start(path.vertices.front());
    for (std::size_t i = 0; i < path.vertices.size() && !budget_.exhausted(); ++i) {
      const VertexIndex spur = path.vertices[i];
      if (i > 0 && query_.avoided.contains(spur)) return;  // a goal that no path passes
      query.from = {{spur, 0.0}};
      query.to = goals;
      query.costs = query_.costs;
      close_taken(path, i, query);
      if (!query.to.empty()) add(path, i, root_cost, search_.find(hierarchy_, query, budget_));
      if (i == path.routes.size()) return;
      query.avoided.insert(spur);
      std::erase_if(goals, [&](const SearchEnd& end) { return end.vertex == spur; });
      root_cost += cost_of(path.routes[i]);
    }
  }

  // Closes how the paths taken so far continue that begin like this one for `length` routes: their next route, or their
  // end there.
  void close_taken(const GraphPath& path, std::size_t length, RouteQuery& query) const {
    const auto end = path.routes.begin() + static_cast<std::ptrdiff_t>(length);
    for (const GraphPath& other : taken_) {
      if (other.routes.size() < length || other.vertices.front() != path.vertices.front() ||
          !std::equal(path.routes.begin(), end, other.routes.begin()))
        continue;
      if (other.routes.size() > length)
        query.costs[other.routes[length]] = kNoRoute;
      else
        std::erase_if(query.to, [&](const SearchEnd& goal) { return goal.vertex == other.vertices.back(); });
    }
  }

  void add(const GraphPath& root, std::size_t length, double root_cost, GraphPath spur) {
    if (spur.stopped || !(spur.cost < kNoRoute)) return;
    GraphPath path;
    path.vertices.assign(root.vertices.begin(), root.vertices.begin() + static_cast<std::ptrdiff_t>(length));
    path.routes.assign(root.routes.begin(), root.routes.begin() + static_cast<std::ptrdiff_t>(length));
    path.vertices.insert(path.vertices.end(), spur.vertices.begin(), spur.vertices.end());
    path.routes.insert(path.routes.end(), spur.routes.begin(), spur.routes.end());
    path.cost = root_cost + spur.cost;
    path.settled = spur.settled;
    if (known_.emplace(path.vertices.front(), path.routes).second) candidates_.push_back(std::move(path));
  }

  const Hierarchy& hierarchy_;
  const RouteQuery& query_;
  GraphSearch& search_;
  const Budget& budget_;
  std::vector<GraphPath> taken_, candidates_;
  std::set<std::pair<VertexIndex, std::vector<RouteId>>> known_;
  std::set<VertexIndex> begins_at_;
};

}  // namespace

std::vector<GraphPath> alternatives_to(const GraphPath& best, int count, const Hierarchy& hierarchy,
                                       const RouteQuery& query, GraphSearch& search, const Budget& budget) {
  return Yen(hierarchy, query, search, budget).after(best, count);
}

}  // namespace cairn
