#include "planners/hybrid/hybrid_planner.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "planners/disc_space/ends.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

UnknownPolicy unknown_policy_of(const PluginChoice& route) {
  const ConfigValue* unknown = route.config.find("unknown");
  return unknown != nullptr && (unknown->scalar == "allow" || unknown->scalar == "cost") ? UnknownPolicy::allow
                                                                                         : UnknownPolicy::avoid;
}

HybridPlanner::HybridPlanner(HybridConfig config, std::shared_ptr<const Planner> route,
                             std::shared_ptr<const Planner> graph)
    : config_(std::move(config)),
      unknown_(unknown_policy_of(config_.route)),
      route_(std::move(route)),
      graph_(std::move(graph)) {
  if (!route_ || !graph_) throw std::invalid_argument("hybrid: needs a route planner and a graph planner");
}

void HybridPlanner::prepare(const WorldView& world, double radius_m) const {
  if (world.grid.bounds().empty() || is_larger_than(world.grid, radius_m)) return;
  const auto space = usual_.spaces.space_of(world.grid, {unknown_, {}}, world.grid_version);
  (void)usual_.routes.routes_of(space, radius_m + kLeastRadius_m);
  route_->prepare(world, radius_m);
}

// Landmark legs are joined and smoothed for a disc that turns on the spot.
bool is_for_discs(const PluginChoice& route) {
  const ConfigValue* const kinematics = route.config.find("kinematics");
  const ConfigValue* const footprint = route.config.find("footprint");
  return (kinematics == nullptr || kinematics->scalar == "disc") &&
         (footprint == nullptr || footprint->scalar == "disc");
}

PlanResult HybridPlanner::plan_without_landmarks(const PlanRequest& request, const WorldView& world,
                                                 const Budget& budget) const {
  PlanResult result = route_->plan(request, world, budget);
  if (result.outcome == PlanOutcome::solved) result.pieces = {{PlanPiece::Origin::planned, 0, result.length_m}};
  result.reason = "directly, since landmark legs are for a disc that turns on the spot; " + result.reason;
  return result;
}

PlanResult HybridPlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  if (!(request.radius_m >= 0.0 && std::isfinite(request.radius_m)))
    throw std::invalid_argument("hybrid: radius_m must be finite and not negative, got " +
                                std::to_string(request.radius_m));
  if (!is_for_discs(config_.route) && !world.grid.bounds().empty())
    return plan_without_landmarks(request, world, budget);
  const auto begin = Budget::Clock::now();
  PlanResult result =
      answer_over_landmarks({config_, unknown_, usual_, avoiding_, *route_, *graph_}, request, world, budget);
  result.time_ms.total_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  return result;
}

}  // namespace cairn
