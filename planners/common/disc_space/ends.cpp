#include "planners/common/disc_space/ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

Refusal start_blocked(const OccupancyGrid& grid, const DiscSpace& space, const Point& at, double radius_m) {
  return {PlanOutcome::start_blocked, "the start " + text_of(at) +
                                          " is blocked: " + why_blocked(grid, space, at, radius_m) +
                                          nearest_free_text(space, at, radius_m + kMinRadius_m)};
}

std::optional<OccupancyGrid> with_ground_covered(const Pose2& pose, const OccupancyGrid& grid, const EndRules& rules) {
  if (!rules.covering) return with_ground_under(grid, rules.ground, pose.position(), rules.radius_m + kMinRadius_m);
  return with_ground_under(grid, rules.ground, pose.position(), rules.covering->reach_m,
                           [&](Cell cell) { return rules.covering->covers(pose, cell); });
}

std::variant<StartPlace, Refusal> start_at_pose(const Pose2& pose, const WorldView& world, const EndRules& rules,
                                                const SpaceCache& spaces) {
  StartPlace start;
  start.pose = pose;
  const Point at = pose.position();
  if (robot_stands_at(world, at)) start.patched_grid = with_ground_covered(pose, world.grid, rules);
  const OccupancyGrid& grid = start.grid_of(world);
  start.space = spaces.space_of(grid, rules.ground, start.patched_grid ? 0 : world.grid_version);
  start.leave_from = at;
  if (start.space->fits(at, rules.radius_m + kMinRadius_m)) return start;
  start.escape = escape_from(grid, *start.space, at, rules.radius_m, rules.start_tolerance_m);
  if (!start.escape) return start_blocked(grid, *start.space, at, rules.radius_m);
  start.leave_from = start.escape->to;
  return start;
}

std::string not_reached_text(const Place& goal, const LandmarkGraph& graph) {
  if (goal.pose) return "the goal " + text_of(goal.pose->position()) + " cannot be reached";
  const std::string first = label_of(*graph.find(goal.landmarks.front()));
  if (goal.landmarks.size() == 1) return first + " cannot be reached";
  return fmt::format("none of {} goals ({}, ...) can be reached", goal.landmarks.size(), first);
}

// No path at all, or none for a robot of this size?
Refusal unreached(const Place& place, const WorldView& world, const EndRules& rules, const StartPlace& start,
                  const std::vector<Point>& goals) {
  const auto is_open = [&](const Point& goal) { return start.space->joined(start.leave_from, goal); };
  if (std::any_of(goals.begin(), goals.end(), is_open)) return too_narrow(place, world.graph, rules.radius_m);
  return {PlanOutcome::no_route,
          not_reached_text(place, world.graph) + ": what is free around the start ends before it"};
}

std::string note_on(const Pose2& approach, const Landmark& landmark) {
  const Point usual = landmark.approach_pose().position();
  const double away_m = (approach.position() - usual).norm();
  if (away_m == 0.0) return {};
  return "; it ends " + metres_text(away_m) + " from " +
         (landmark.access ? "the approach pose of " + label_of(landmark) + ", where there is too little room"
                          : label_of(landmark));
}

}  // namespace

PlanOutcome stop_outcome(const Budget& budget) {
  return budget.cancelled() ? PlanOutcome::cancelled : PlanOutcome::out_of_budget;
}

Refusal stopped(PlanOutcome stop_outcome) {
  if (stop_outcome == PlanOutcome::cancelled) return {stop_outcome, "the search for a route was cancelled"};
  return {stop_outcome, "the budget was used up before a route was found"};
}

void check_radius(const std::string& planner, double radius_m) {
  if (!(radius_m >= 0.0 && std::isfinite(radius_m)))
    throw std::invalid_argument(
        fmt::format("{}: radius_m must be finite and not negative, got {:f}", planner, radius_m));
}

std::string escape_text(const StartPlace& start) {
  if (!start.escape) return {};
  return fmt::format(
      "; the start is too near to something and is left towards {} with less clearance than the robot's radius asks "
      "for",
      text_of(start.escape->to));
}

bool is_larger_than(const OccupancyGrid& grid, double radius_m) {
  const CellBox box = grid.bounds();
  return radius_m > std::hypot(box.width(), box.height()) * grid.cell_m();
}

Refusal too_narrow(const Place& goal, const LandmarkGraph& graph, double radius_m) {
  return {PlanOutcome::no_route, not_reached_text(goal, graph) +
                                     ": the path there is too narrow for a robot of radius " + metres_text(radius_m)};
}

std::optional<Refusal> refusal_of_place(const Place& place, const LandmarkGraph& graph, const std::string& end) {
  if (place.pose) {
    if (is_finite(*place.pose)) return std::nullopt;
    return Refusal{PlanOutcome::unknown_place, "the " + end + " is not a place: its numbers are not finite"};
  }
  if (place.landmarks.empty()) return Refusal{PlanOutcome::unknown_place, "the request names no " + end};
  for (const LandmarkId id : place.landmarks)
    if (graph.find(id) == nullptr)
      return Refusal{PlanOutcome::unknown_place, fmt::format("the map has no landmark L{} ({})", id, end)};
  return std::nullopt;
}

std::variant<StartPlace, Refusal> start_of(const Place& place, const WorldView& world, const EndRules& rules,
                                           const SpaceCache& spaces) {
  if (const auto refusal = refusal_of_place(place, world.graph, "start")) return *refusal;
  if (world.grid.bounds().empty())
    return Refusal{PlanOutcome::start_blocked, "the map holds no grid to plan a route on"};
  if (is_larger_than(world.grid, rules.radius_m))
    return Refusal{PlanOutcome::start_blocked,
                   "a robot of radius " + metres_text(rules.radius_m) + " is larger than the map"};
  if (place.pose) return start_at_pose(*place.pose, world, rules, spaces);
  const auto space = spaces.space_of(world.grid, rules.ground, world.grid_version);
  for (const LandmarkId id : place.landmarks) {
    const std::optional<Pose2> approach = approach_pose(*space, *world.graph.find(id), rules.radius_m + kMinRadius_m);
    if (!approach) continue;
    auto start = start_at_pose(*approach, world, rules, spaces);
    if (auto* found = std::get_if<StartPlace>(&start)) found->landmark = id;
    return start;
  }
  return Refusal{PlanOutcome::start_blocked, "there is no free place to stand near " +
                                                 label_of(*world.graph.find(place.landmarks.front())) +
                                                 ", where the route is to start"};
}

std::variant<std::vector<GoalPlace>, Refusal> goals_of(const Place& place, const WorldView& world,
                                                       const EndRules& rules, const StartPlace& start,
                                                       const MayReach& may_reach) {
  if (const auto refusal = refusal_of_place(place, world.graph, "goal")) return *refusal;
  const DiscSpace& space = *start.space;
  const double radius_m = rules.radius_m + kMinRadius_m;
  if (place.pose) {
    const Point at = place.pose->position();
    if (!space.fits(at, radius_m))
      return Refusal{PlanOutcome::goal_blocked, "the goal " + text_of(at) + " is blocked: " +
                                                    why_blocked(start.grid_of(world), space, at, rules.radius_m) +
                                                    nearest_free_text(space, at, radius_m)};
    if (!may_reach(at)) return unreached(place, world, rules, start, {at});
    const std::optional<double> heading = place.heading_matters ? std::optional(place.pose->theta_rad) : std::nullopt;
    return std::vector{GoalPlace{*place.pose, heading, 0, ""}};
  }
  std::vector<GoalPlace> goals;
  std::vector<Point> out_of_reach;
  for (const LandmarkId id : place.landmarks) {
    const Landmark& landmark = *world.graph.find(id);
    if (const auto approach = approach_pose(space, landmark, radius_m, may_reach)) {
      goals.push_back({*approach, std::nullopt, id, note_on(*approach, landmark)});
    } else if (const auto anywhere = approach_pose(space, landmark, radius_m)) {
      out_of_reach.push_back(anywhere->position());
    }
  }
  if (!goals.empty()) return goals;
  if (!out_of_reach.empty()) return unreached(place, world, rules, start, out_of_reach);
  return Refusal{PlanOutcome::goal_blocked,
                 "there is no free place to stand near " + label_of(*world.graph.find(place.landmarks.front()))};
}

}  // namespace cairn
