#include "planners/hybrid/hybrid_planner.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/avoided.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

HybridPlanner::HybridPlanner(HybridConfig config, std::shared_ptr<const PathPlanner> path_planner,
                             std::shared_ptr<const RoutePlanner> route_planner)
    : config_(std::move(config)), path_planner_(std::move(path_planner)), route_planner_(std::move(route_planner)) {
  if (!path_planner_ || !route_planner_)
    throw std::invalid_argument("hybrid: needs a path planner and a route planner");
  traits_ = path_planner_->traits();
}

void HybridPlanner::prepare(const WorldView& world, double radius_m) const {
  const double disc_m = radius_m + traits_.margin_m;
  if (world.grid.bounds().empty() || is_larger_than(world.grid, disc_m)) return;
  if (is_for_discs() && is_answered_in_windows(world)) return;
  path_planner_->prepare(world, radius_m);
  if (!is_for_discs()) return;
  const auto space = usual_.spaces.space_of(world.grid, {traits_.unknown, {}}, world.grid_version);
  (void)usual_.routes.routes_of(space, disc_m + kMinRadius_m);
}

PlanResult HybridPlanner::plan_without_landmarks(const PlanRequest& request, const WorldView& world,
                                                 const Budget& budget) const {
  std::optional<OccupancyGrid> avoiding;
  const bool has_ends = !refusal_of_place(request.from, world.graph, "start") &&
                        !refusal_of_place(request.to, world.graph, "goal") &&
                        !is_larger_than(world.grid, request.radius_m);
  if (!request.avoid.empty() && has_ends) {
    const auto space = usual_.spaces.space_of(world.grid, {traits_.unknown, {}}, world.grid_version);
    avoiding = with_avoided_blocked(world, request, *space, request.radius_m + kMinRadius_m);
  }
  PlanRequest direct = request;
  direct.avoid.clear();  // the grid says so
  PlanResult result =
      LonePathPlanner(path_planner_).plan(direct, avoiding ? with_grid(*avoiding, world) : world, budget);
  if (avoiding && result.outcome != PlanOutcome::solved) result.reason += kAvoidedCount;
  if (result.outcome == PlanOutcome::solved) result.segments = {{PathSegment::Origin::planned, 0, result.length_m}};
  result.reason = "directly, since landmark legs are for a disc that turns on the spot; " + result.reason;
  return result;
}

PlanResult HybridPlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  check_radius("hybrid", request.radius_m);
  if (!is_for_discs() && !world.grid.bounds().empty()) return plan_without_landmarks(request, world, budget);
  const auto begin = Budget::Clock::now();
  PlanResult result = answer_over_landmarks(
      {config_, traits_, usual_, avoiding_, windows_, *path_planner_, route_planner_}, request, world, budget);
  result.time_ms.total_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  return result;
}

}  // namespace cairn
