// A request on a large grid, answered over landmarks in windows of it.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "planners/hybrid/answers.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

struct LocalAnswer {
  std::optional<PlanResult> result;  // none: the whole grid has to be searched
  std::string why_none;              // as the end of a sentence
};

// The ends are joined to the landmarks that are reached in windows round them, which grow until there are some. Routes
// are followed by their stored trajectories, and what has to be planned is planned in windows. Without landmarks only
// where the ends are near each other: when the path over landmarks is a detour or there is none. Looks at no cell that
// is far from the path, and at none twice for a second request nearby. Says that there is no route never.
[[nodiscard]] LocalAnswer answer_locally(const HybridTools& tools, const EndRules& ends, const LegRules& legs,
                                         const AnswerRules& answers, const WindowRules& windows,
                                         const PlanRequest& request, const WorldView& world, const Budget& budget);

}  // namespace cairn
