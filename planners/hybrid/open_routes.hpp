// Other routes over the landmark graph that are not blocked today.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "planners/hybrid/legs.hpp"

namespace cairn {

// Whether routes can be driven now, each checked once.
class OpenRoutes {
 public:
  // Routes found blocked are added to `blocked`.
  OpenRoutes(const LandmarkGraph& graph, const Walker& walker, std::set<RouteId>& blocked)
      : graph_(graph), walker_(walker), blocked_(blocked) {}

  [[nodiscard]] bool are_open(const std::vector<RouteId>& routes);
  [[nodiscard]] const std::set<RouteId>& blocked() const { return blocked_; }

 private:
  [[nodiscard]] bool is_open(RouteId id);

  const LandmarkGraph& graph_;
  Walker walker_;
  std::set<RouteId>& blocked_;
  std::set<RouteId> open_;
};

// Up to `count` of `candidates` that are open and not the answer's own `routes`; where some are blocked, the graph is
// searched on without their blocked routes. Fewer when there are no more or the budget ends.
[[nodiscard]] std::vector<RouteAlternative> open_alternatives(const SymbolicSearch& search,
                                                              std::vector<RouteAlternative> candidates,
                                                              const std::vector<RouteId>& routes, int count,
                                                              OpenRoutes open, const Budget& budget);

}  // namespace cairn
