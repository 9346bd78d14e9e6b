#include "planners/landmark_search/alternatives.hpp"

#include <algorithm>
#include <set>

namespace cairn {
namespace {

class Yen {
 public:
  Yen(const Hierarchy& hierarchy, const RouteQuery& query, HierarchySearch& search, const Budget& budget)
      : hierarchy_(hierarchy), query_(query), search_(search), budget_(budget) {}

  std::vector<Way> after(const Way& best, int count) {
    taken_.push_back(best);
    while (static_cast<int>(taken_.size()) <= count) {
      leave(taken_.back());
      if (candidates_.empty() || budget_.exhausted()) break;
      const auto next = std::min_element(candidates_.begin(), candidates_.end(), [](const Way& a, const Way& b) {
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
    return kNoWay;
  }
  double cost_of_start(VertexIndex v) const {
    double cost = kNoWay;
    for (const SearchEnd& end : query_.from)
      if (end.vertex == v) cost = std::min(cost, end.cost);
    return cost;
  }

  // The ways that leave this one at each of its landmarks, or begin elsewhere.
  void leave(const Way& way) {
    RouteQuery query = query_;
    begins_at_.insert(way.vertices.front());
    std::erase_if(query.from, [&](const SearchEnd& end) { return begins_at_.contains(end.vertex); });
    if (!query.from.empty()) add(way, 0, 0.0, search_.find(hierarchy_, query, budget_));
    std::vector<SearchEnd> goals = query_.to;  // without landmarks passed before
    query = query_;
    double root_cost = cost_of_start(way.vertices.front());
    for (std::size_t i = 0; i < way.vertices.size() && !budget_.exhausted(); ++i) {
      const VertexIndex spur = way.vertices[i];
      if (i > 0 && query_.avoided.contains(spur)) return;  // a goal that no way passes
      query.from = {{spur, 0.0}};
      query.to = goals;
      query.costs = query_.costs;
      close_taken(way, i, query);
      if (!query.to.empty()) add(way, i, root_cost, search_.find(hierarchy_, query, budget_));
      if (i == way.routes.size()) return;
      query.avoided.insert(spur);
      std::erase_if(goals, [&](const SearchEnd& end) { return end.vertex == spur; });
      root_cost += cost_of(way.routes[i]);
    }
  }

  // How the ways taken so far that begin like this one go on after `length` routes, or that they end there.
  void close_taken(const Way& way, std::size_t length, RouteQuery& query) const {
    const auto end = way.routes.begin() + static_cast<std::ptrdiff_t>(length);
    for (const Way& other : taken_) {
      if (other.routes.size() < length || other.vertices.front() != way.vertices.front() ||
          !std::equal(way.routes.begin(), end, other.routes.begin()))
        continue;
      if (other.routes.size() > length)
        query.costs[other.routes[length]] = kNoWay;
      else
        std::erase_if(query.to, [&](const SearchEnd& goal) { return goal.vertex == other.vertices.back(); });
    }
  }

  void add(const Way& root, std::size_t length, double root_cost, Way spur) {
    if (spur.stopped || !(spur.cost < kNoWay)) return;
    Way way;
    way.vertices.assign(root.vertices.begin(), root.vertices.begin() + static_cast<std::ptrdiff_t>(length));
    way.routes.assign(root.routes.begin(), root.routes.begin() + static_cast<std::ptrdiff_t>(length));
    way.vertices.insert(way.vertices.end(), spur.vertices.begin(), spur.vertices.end());
    way.routes.insert(way.routes.end(), spur.routes.begin(), spur.routes.end());
    way.cost = root_cost + spur.cost;
    way.settled = spur.settled;
    if (known_.emplace(way.vertices.front(), way.routes).second) candidates_.push_back(std::move(way));
  }

  const Hierarchy& hierarchy_;
  const RouteQuery& query_;
  HierarchySearch& search_;
  const Budget& budget_;
  std::vector<Way> taken_, candidates_;
  std::set<std::pair<VertexIndex, std::vector<RouteId>>> known_;
  std::set<VertexIndex> begins_at_;
};

}  // namespace

std::vector<Way> alternatives_to(const Way& best, int count, const Hierarchy& hierarchy, const RouteQuery& query,
                                 HierarchySearch& search, const Budget& budget) {
  return Yen(hierarchy, query, search, budget).after(best, count);
}

}  // namespace cairn
