// A question by names, as a request to a planner over the landmarks that a map holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/plan_question.hpp"
#include "framework/contracts/planner.hpp"
#include "maps/clustering/cluster_tree.hpp"

namespace cairn {

// Throws std::invalid_argument, with a sentence, on a question that no map could answer.
void check(const PlanQuestion& question);
// "length", "time" or "clearance". Throws std::invalid_argument with the nearest name.
[[nodiscard]] CostKind cost_kind_of(const std::string& name);

struct PlanTask {
  PlanRequest request;
  std::vector<Place> via;  // stops in between
};
// here: what the place `here` stands for; without it, that is a name like any other. Throws PlaceError.
[[nodiscard]] PlanTask task_of(const PlanQuestion& question, const LandmarkGraph& graph, const ClusterTree& clusters,
                               const std::optional<Pose2>& here = std::nullopt);

}  // namespace cairn
