#include "planners/hybrid/legs.hpp"

#include <algorithm>
#include <limits>

namespace cairn {
namespace {

constexpr double kShort_m = 0.1;  // over which no other path is looked for, whatever room there is

}  // namespace

bool Walker::is_passable(const std::vector<Pose2>& trajectory) const {
  if (trajectory.empty()) return false;
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    if (!ground_.fits_along(trajectory[i == 0 ? 0 : i - 1].position(), trajectory[i].position())) return false;
  return true;
}

std::optional<PlanOutcome> Walker::stopped() const {
  if (budget_.cancelled()) return PlanOutcome::cancelled;
  return budget_.past_deadline() ? std::optional(PlanOutcome::out_of_budget) : std::nullopt;
}

Walker::Step Walker::go_to(const Point& to, RouteId leg, Walk& walk, double at_most_m) const {
  const Point from = walk.route.back().at;
  if (from == to) return Step::done;
  const double clearance_m = (to - from).norm() <= kShort_m ? 0.0 : rules_.straight_clearance_m;
  if (ground_.fits_with(from, to, clearance_m)) {
    walk.add_part(PathSegment::Origin::straight, leg);
    walk.go_on_to(to);
    walk.cost_m += (to - from).norm();
    return Step::done;
  }
  PathRequest request;
  request.from.pose = Pose2{from.x(), from.y(), 0.0};
  request.to.pose = Pose2{to.x(), to.y(), 0.0};
  request.radius_m = rules_.radius_m;
  request.seed = rules_.seed;
  request.speed_mps = rules_.speed_mps;
  const PathResult planned = ground_.path(request, budget_);
  if (planned.outcome == PlanOutcome::cancelled || budget_.exhausted()) {
    walk.stopped = stopped().value_or(planned.outcome);
    return Step::stopped;
  }
  // A longer one may have been chosen because it is faster.
  const bool is_for_time = rules_.straight_clearance_m > 0.0;
  const double least_m = is_for_time ? planned.length_lower_bound_m.value_or(planned.length_m) : planned.length_m;
  if (planned.outcome != PlanOutcome::solved || least_m > at_most_m) return Step::failed;
  // The path planner may leave its start with less clearance: check.
  if (!is_passable(planned.path) || planned.path.back().position() != to) return Step::failed;
  walk.add_part(PathSegment::Origin::planned, leg);
  for (std::size_t i = 1; i < planned.path.size(); ++i) walk.go_on_to(planned.path[i].position());
  walk.cost_m += planned.length_m;
  return Step::done;
}

void Walker::take_access_leg(const Point& to, Walk& walk) const {
  if (go_to(to, 0, walk, std::numeric_limits<double>::infinity()) == Step::failed) walk.access_leg_failed = true;
}

void Walker::take_leg(const Route& leg, Walk& walk) const {
  if (is_passable(leg.trajectory)) {
    take_access_leg(leg.trajectory.front().position(), walk);
    if (!walk.complete()) return;
    walk.add_part(PathSegment::Origin::stored, leg.id);
    for (const Pose2& pose : leg.trajectory) walk.go_on_to(pose.position());
    walk.cost_m += leg.cost_m;
    ++walk.stored_legs;
    return;
  }
  const auto at_landmark = approach(leg.to);
  const Point from = walk.route.back().at;
  const double straight_m = at_landmark ? (at_landmark->position() - from).norm() : 0.0;
  const double at_most_m = rules_.detour_ratio * std::max(leg.cost_m, straight_m);
  if (!at_landmark || go_to(at_landmark->position(), leg.id, walk, at_most_m) == Step::failed) walk.blocked = leg.id;
  ++walk.planned_legs;
}

Walk Walker::walk(const Point& from, const SymbolicPath& path, const Pose2& goal) const {
  Walk walk;
  walk.route = {{from, 0}};
  // A leg without a passable trajectory begins at its landmark's approach pose.
  const Route& first = *ground_.world().graph.find_route(path.routes.front());
  if (!is_passable(first.trajectory)) {
    const auto at_landmark = approach(first.from);
    if (at_landmark) take_access_leg(at_landmark->position(), walk);
  }
  for (const RouteId id : path.routes) {
    if (walk.complete()) walk.stopped = stopped();
    if (!walk.complete()) return walk;
    take_leg(*ground_.world().graph.find_route(id), walk);
  }
  if (walk.complete()) take_access_leg(goal.position(), walk);
  return walk;
}

Walk Walker::walk_alone(const Route& leg) const {
  Walk walk;
  const auto at_landmark = approach(leg.from);
  walk.stopped = stopped();
  if (!at_landmark) walk.blocked = leg.id;
  if (!walk.complete()) return walk;
  walk.route = {{is_passable(leg.trajectory) ? leg.trajectory.front().position() : at_landmark->position(), 0}};
  take_leg(leg, walk);
  return walk;
}

}  // namespace cairn
