// How the route driver finds a path: by the planner, on the local map, and by looking again.

#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/lookouts/goal_lookout.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

Status RouteDriver::plan(const WorldView& world, BehaviourContext& context) {
  if (!requests_.may_plan(world.time_s)) return {StepState::running, "waiting to plan again"};
  if (requests_.is_used_up()) return give_up(world);
  if (ladder_.plans_round_it() && plan_locally(world, Optimism::none)) {
    set_mode(Mode::travel, world.time_s);
    return {StepState::running, "going round what blocked it"};
  }
  const PlanResult result = requests_.ask(goal_.place(), world, context);
  if (result.outcome != PlanOutcome::solved) return without_route(result, world, context);
  take_route(result, world);
  set_mode(Mode::travel, world.time_s);
  return {StepState::running, "under way"};
}

// Something has turned up on the path: another path, if there is one.
void RouteDriver::plan_past(const WorldView& world, BehaviourContext& context) {
  if (follower_.optimism()) {
    if (!requests_.may_plan_locally(world.time_s)) return;
    requests_.note_local_plan(world.time_s);
    (void)plan_locally(world, *follower_.optimism());  // without one it goes on: live echoes say what is there
    return;
  }
  const PlanResult result = requests_.ask(goal_.place(), world, context);
  if (result.outcome == PlanOutcome::solved) take_route(result, world);
}

void RouteDriver::take(const std::vector<Point>& path, Leg leg) {
  follower_.take(path, leg);
  map_.ignore_nothing();
}

void RouteDriver::take_local(const LocalPath& path, const WorldView& world) {
  follower_.take_local(path.points, path.optimism);
  requests_.note_local_plan(world.time_s);
  map_.ignore_nothing();
  map_.ignore_doubtful(path.optimism, world, look_.doubts());
  if (path.optimism == Optimism::narrow_gaps) map_.ignore_along(path.points, world, look_.doubts());
}

void RouteDriver::take_route(const PlanResult& result, const WorldView& world) {
  follower_.take_route(result, goal_.place(), world.grid.cell_m());
  map_.ignore_nothing();
  goal_.record(result, follower_.path());
}

bool RouteDriver::plan_locally(const WorldView& world, Optimism optimism) {
  const std::optional<Point> goal = goal_.point(world.graph);
  if (!goal) return false;
  const std::optional<LocalPath> path = local_planning_.path(*goal, optimism, world, map_, look_);
  if (path) take_local(*path, world);
  return path.has_value();
}

Status RouteDriver::without_route(const PlanResult& result, const WorldView& world, BehaviourContext& context) {
  const std::string why = std::string(name_of(result.outcome)) + ": " + result.reason;
  Status failed{StepState::failure, why + (tried_.empty() ? "" : "; " + tried_)};
  if (is_refusal(result.outcome)) return failed;
  if (result.outcome == PlanOutcome::start_blocked && begin_escape(world)) {
    set_mode(Mode::travel, world.time_s);
    return {StepState::running, "leaving a tight place"};
  }
  const std::optional<Point> goal = goal_.point(world.graph);
  if (const auto path = goal ? local_planning_.next_path(*goal, world, map_, look_) : std::nullopt) {
    take_local(*path, world);
    set_mode(Mode::travel, world.time_s);
    return {StepState::running, path->optimism == Optimism::narrow_gaps ? "trying an opening that looks too narrow"
                                                                        : "under way on the local map"};
  }
  if (begin_look(result.outcome, world)) {
    context.report("no path now (" + why + "): looks again at " + described(look_.target().at));
    set_mode(Mode::travel, world.time_s);
    return {StepState::running, "going to look at " + described(look_.target().at)};
  }
  return failed;
}

// Too near to something to plan: a little further from it first.
bool RouteDriver::begin_escape(const WorldView& world) {
  const Point goal = goal_.point(world.graph).value_or(world.pose.T_map_robot.position());
  const std::optional<std::vector<Point>> path = local_planning_.escape(goal, world, map_, look_);
  if (!path) return false;
  take(*path, Leg::escape);
  tried_ = "left tight places " + std::to_string(local_planning_.escapes()) + " times";
  return true;
}

// Where the goal itself is blocked, from beside it: nothing else blocks the robot then.
bool RouteDriver::begin_look(PlanOutcome outcome, const WorldView& world) {
  const std::optional<Point> goal = goal_.point(world.graph);
  if (!goal || !look_.may_drive_to_look()) return false;
  if (outcome == PlanOutcome::goal_blocked && goal_.is_exact() && begin_look_at_goal(*goal, world)) return true;
  if (outcome == PlanOutcome::goal_blocked && !look_.stood_beside_goal().empty()) return false;
  const double clearance_m = settings_.driving.local_map.tight_clearance_m;
  const std::optional<LookoutRoute> route =
      lookout_route(space(world, clearance_m, Optimism::none), world.grid, world.pose.T_map_robot.position(), *goal,
                    look_.looked_at(), look_.stand_off_m(), settings_.driving.lookout_costs);
  if (!route) return false;
  go_to_look(*route, look_.target_at(route->at));
  look_.remember_looked_at(route->at);
  return true;
}

// Walls are drawn thick where they have been seen from afar, and people leave traces: from right beside the goal it may
// be free. Each time from another place, then from the same ones again: somebody may leave.
bool RouteDriver::begin_look_at_goal(const Point& goal, const WorldView& world) {
  const LookSettings& look = settings_.driving.look;
  const GoalLookout lookout{world.robot.radius_m + look.beside_goal_m, look.beside_goal_apart_m, look.before_goal_m};
  for (const Optimism optimism : {Optimism::none, Optimism::no_speckles, Optimism::unknown_free}) {
    const FreeSpace around = space(world, settings_.driving.local_map.tight_clearance_m, optimism);
    std::optional<Cell> beside = cell_beside(goal, around, look_.stood_beside_goal(), lookout);
    if (!beside) beside = cell_beside(goal, around, {}, lookout);
    if (!beside) continue;
    BlockageLook::Target target = look_.target_at(goal);
    target.at_most_s = look.beside_goal_at_most_s;
    target.is_goal = true;
    go_to_look({goal, around.path_to(*beside)}, target);
    map_.ignore_doubtful(optimism, world, look_.doubts());
    look_.remember_looked_at(goal);
    return true;
  }
  return false;
}

void RouteDriver::go_to_look(const LookoutRoute& route, const BlockageLook::Target& target) {
  look_.count_drive();
  take(route.path, Leg::to_look);
  tried_ = "looked " + std::to_string(look_.looks()) + " times whether the path is free again, last at " +
           described(route.at);
  look_.aim_at(target);
}

}  // namespace cairn::behaviours
