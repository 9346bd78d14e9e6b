#include "planners/hybrid/hybrid_planner.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "maps/base/text.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/avoided.hpp"
#include "planners/hybrid/hybrid_query.hpp"

namespace cairn {

UnknownPolicy unknown_policy_of(const PluginChoice& route) {
  const ConfigValue* unknown = route.config.find("unknown");
  return unknown != nullptr && (unknown->scalar == "allow" || unknown->scalar == "cost") ? UnknownPolicy::allow
                                                                                         : UnknownPolicy::avoid;
}

double margin_m_of(const PluginChoice& route) {
  const ConfigValue* const margin = route.config.find("margin_m");
  return margin == nullptr ? 0.0 : number_from<double>(margin->scalar).value_or(0.0);
}

HybridPlanner::HybridPlanner(HybridConfig config, std::shared_ptr<const Planner> route,
                             std::shared_ptr<const Planner> graph)
    : config_(std::move(config)),
      unknown_(unknown_policy_of(config_.route)),
      margin_m_(margin_m_of(config_.route)),
      route_(std::move(route)),
      graph_(std::move(graph)) {
  if (!route_ || !graph_) throw std::invalid_argument("hybrid: needs a route planner and a graph planner");
}

void HybridPlanner::prepare(const WorldView& world, double radius_m) const {
  const double disc_m = radius_m + margin_m_;
  if (world.grid.bounds().empty() || is_larger_than(world.grid, disc_m)) return;
  route_->prepare(world, radius_m);
  if (!is_for_discs(config_.route)) return;
  const auto space = usual_.spaces.space_of(world.grid, {unknown_, {}}, world.grid_version);
  (void)usual_.routes.routes_of(space, disc_m + kMinRadius_m);
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
  std::optional<OccupancyGrid> avoiding;
  const bool has_ends = !refusal_of_place(request.from, world.graph, "start") &&
                        !refusal_of_place(request.to, world.graph, "goal") &&
                        !is_larger_than(world.grid, request.radius_m);
  if (!request.avoid.empty() && has_ends) {
    const auto space = usual_.spaces.space_of(world.grid, {unknown_, {}}, world.grid_version);
    avoiding = with_avoided_blocked(world, request, *space, request.radius_m + kMinRadius_m);
  }
  PlanResult result = route_->plan(request, avoiding ? with_grid(*avoiding, world) : world, budget);
  if (avoiding && result.outcome != PlanOutcome::solved) result.reason += kAvoidedCount;
  if (result.outcome == PlanOutcome::solved) result.segments = {{PathSegment::Origin::planned, 0, result.length_m}};
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
  PlanResult result = answer_over_landmarks({config_, unknown_, margin_m_, usual_, avoiding_, *route_, *graph_},
                                            request, world, budget);
  result.time_ms.total_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  return result;
}

}  // namespace cairn
