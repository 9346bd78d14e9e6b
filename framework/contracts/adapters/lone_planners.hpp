// A path planner or a route planner alone in the place of a mission's planner.
#pragma once

#include <memory>

#include "framework/contracts/path_planner.hpp"
#include "framework/contracts/planner.hpp"

namespace cairn {

// Paths on the grid only: what a request says about the landmark graph is ignored.
class LonePathPlanner : public Planner {
 public:
  explicit LonePathPlanner(std::shared_ptr<const PathPlanner> paths) : paths_(std::move(paths)) {}
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;
  void prepare(const WorldView& world, double radius_m) const override { paths_->prepare(world, radius_m); }

 private:
  std::shared_ptr<const PathPlanner> paths_;
};

// Routes from landmark to landmark only: a pose as an end is an unknown place. The path joins the stored trajectories,
// or the landmarks' approach poses where there is none; it is not checked against the grid.
class LoneRoutePlanner : public Planner {
 public:
  explicit LoneRoutePlanner(std::shared_ptr<const RoutePlanner> routes) : routes_(std::move(routes)) {}
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;

 private:
  std::shared_ptr<const RoutePlanner> routes_;
};

// The part of a request that a path planner can answer.
[[nodiscard]] PathRequest path_request_of(const PlanRequest& request);
// The part that a route planner can answer, between the request's landmarks.
[[nodiscard]] RouteRequest route_request_of(const PlanRequest& request);
[[nodiscard]] PlanResult plan_of(PathResult&& found);

}  // namespace cairn
