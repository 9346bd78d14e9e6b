// Answers one request for a robot whose heading matters.
#pragma once

#include "planners/ompl/disc/disc_query.hpp"
#include "planners/ompl/pose/pose_result.hpp"

namespace cairn {

class PoseQuery {
 public:
  // Borrows all of it.
  PoseQuery(const OmplTools& tools, const PathRequest& request, const WorldView& world, const Budget& budget);

  [[nodiscard]] PathResult answer() const;

 private:
  [[nodiscard]] PathResult answer_from(const StartPlace& start) const;
  [[nodiscard]] PathResult answer_to(const StartPlace& start, const GoalPlace& goal, const DiscRoutes& routes,
                                     const PoseSpace& poses) const;
  [[nodiscard]] std::vector<Pose2> goal_poses(const GoalPlace& goal, const std::vector<Point>& guide,
                                              const PoseSpace& poses) const;
  [[nodiscard]] FoundPath find(const PoseProblem& problem, const StartPlace& start) const;
  [[nodiscard]] FoundPath find_along_route(const PoseProblem& problem, const StartPlace& start) const;
  [[nodiscard]] FoundPath find_by_search(const PoseProblem& problem) const;
  void improve(FoundPath& found, const PoseProblem& problem) const;
  [[nodiscard]] std::optional<Refusal> blocked(const Pose2& pose, const std::string& end, PlanOutcome outcome,
                                               const PoseSpace& poses) const;
  [[nodiscard]] bool fits_along(const PoseProblem& problem, const std::vector<Pose2>& states) const;

  OmplTools tools_;
  const PathRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  PoseSetup setup_;
};

}  // namespace cairn
