// What a query finds out beside its path, whichever ground it is planned on.
#pragma once

#include <chrono>
#include <set>

#include "planners/hybrid/symbolic_path.hpp"

namespace cairn {

struct QueryRecord {
  std::set<RouteId> blocked{};
  std::int64_t settled = 0;
  std::vector<RouteAlternative> alternatives{};
  std::optional<RouteExplanation> explanation{};
  double graph_ms = 0.0;
  double route_ms = 0.0;

  // Without the routes that are blocked.
  [[nodiscard]] SymbolicAnswer find(const SymbolicSearch& search) {
    const auto begin = Budget::Clock::now();
    SymbolicAnswer answer = search.find(blocked);
    graph_ms += ms_since(begin);
    settled += answer.settled;
    explanation = answer.explanation;
    return answer;
  }
  // All but the blocked routes, which are reported with their reasons.
  void put_into(PlanResult& result) const {
    result.settled = settled;
    result.alternatives = alternatives;
    result.explanation = explanation;
    result.time_ms.graph_ms = graph_ms;
    result.time_ms.route_ms = route_ms;
  }
  [[nodiscard]] static double ms_since(Budget::Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  }
};

}  // namespace cairn
