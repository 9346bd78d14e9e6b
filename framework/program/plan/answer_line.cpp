#include "framework/program/plan/answer_line.hpp"

#include "framework/planning/plan_answer.hpp"

namespace cairn {

const ClusterTree& clusters_for(const MapPlanner& planner, const PlanResult& result) {
  return result.explanation ? planner.clusters() : planner.map().clusters;
}

std::vector<TrajectoryPoint> trajectory_for(const MapPlanner& planner, const PlanQuery& query,
                                            const PlanResult& result) {
  if (!query.question.trajectory || result.outcome != PlanOutcome::solved) return {};
  return trajectory_of(result.path, planner.robot());
}

std::string json_line_of(const PlanQuery& query, const PlanResult& result, const MapPlanner& planner) {
  return json_text_of({query.id.dump(), query.question, result, planner.map().graph, clusters_for(planner, result),
                       trajectory_for(planner, query, result)}) +
         "\n";
}

}  // namespace cairn
