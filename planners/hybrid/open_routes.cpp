#include "planners/hybrid/open_routes.hpp"

#include <algorithm>

namespace cairn {

bool OpenRoutes::is_open(RouteId id) {
  if (open_.contains(id)) return true;
  if (blocked_.contains(id)) return false;
  const Walk walk = walker_.walk_alone(*graph_.find_route(id));
  if (walk.blocked) blocked_.insert(id);
  if (walk.complete()) open_.insert(id);
  return walk.complete();
}

bool OpenRoutes::are_open(const std::vector<RouteId>& routes) {
  return std::all_of(routes.begin(), routes.end(), [&](RouteId id) { return is_open(id); });
}

std::vector<RouteAlternative> open_alternatives(const SymbolicSearch& search, std::vector<RouteAlternative> candidates,
                                                const std::vector<RouteId>& routes, int count, OpenRoutes open,
                                                const Budget& budget) {
  const auto wanted = static_cast<std::size_t>(count);
  for (;;) {
    const std::size_t blocked_before = open.blocked().size();
    std::vector<RouteAlternative> found;
    for (const RouteAlternative& candidate : candidates)
      if (found.size() < wanted && candidate.routes != routes && open.are_open(candidate.routes))
        found.push_back(candidate);
    const bool all_open = open.blocked().size() == blocked_before;
    if (found.size() == wanted || all_open || budget.exhausted()) return found;
    SymbolicAnswer more = search.find(open.blocked());
    if (more.stopped) return found;
    candidates = std::move(more.candidates);
  }
}

}  // namespace cairn
