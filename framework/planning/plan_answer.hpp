// The answer to a plan question as one line of JSON: of `cairn plan --json`, and of missions that ask.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/plan_question.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/planning/trajectory.hpp"
#include "maps/clustering/cluster_tree.hpp"

namespace cairn {

struct PlanAnswer {
  std::string id_json = "\"\"";  // any JSON value
  const PlanQuestion& question;
  const PlanResult& result;
  const LandmarkGraph& graph;
  const ClusterTree& clusters;                // that an explanation names
  std::vector<TrajectoryPoint> trajectory{};  // given when the question asks for it
  bool with_times = true;                     // of the wall clock: they differ from run to run
};
// One object, without a line's end. Names that are no UTF-8 get replacement characters.
[[nodiscard]] std::string json_text_of(const PlanAnswer& answer);

}  // namespace cairn
