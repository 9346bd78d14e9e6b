// What the route driver does when the robot is blocked: one recovery after the other.

#include <algorithm>
#include <cmath>

#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

FreeSpace RouteDriver::space(const WorldView& world, double clearance_m, Optimism optimism) const {
  const Point goal = goal_.point(world.graph).value_or(world.pose.T_map_robot.position());
  return map_.space(world, clearance_m, optimism, goal, look_.doubts());
}

Status RouteDriver::recover(const WorldView& world, BehaviourContext& context) {
  const RecoverySettings& recovery = settings_.driving.recovery;
  const Pose2& pose = world.pose.T_map_robot;
  has_reported_wait_ = false;
  map_.ignore_nothing();
  const Recovery next = ladder_.next(pose.position(), nearest_ahead(world));
  if (next == Recovery::give_up) return give_up(world);
  const std::optional<Point>& by = ladder_.blocked_by();
  const std::string where = "blocked at " + described(ladder_.blocked_at()) +
                            (by ? " by what is at " + described(*by) : "") + " (" + std::to_string(ladder_.round()) +
                            " of " + std::to_string(settings_.rounds) + "): ";
  map_.avoid(pose * Point{world.robot.radius_m + recovery.avoid_ahead_m, 0.0}, world.time_s + recovery.avoid_for_s);
  if (follower_.optimism() >= Optimism::unknown_free && by) map_.shut(*by, world.time_s + recovery.shut_for_s);
  if (ladder_.round() >= 2) close_route_here(world, context);
  if (next == Recovery::yield && begin_yield(world)) {
    context.report(where + "yields");
    set_mode(Mode::travel, world.time_s);
    return {StepState::running, "yielding"};
  }
  const bool looks = ladder_.without_yielding() == Recovery::back_up_and_look;
  context.report(where + (looks ? "backs up and looks" : "backs up and turns"));
  set_mode(Mode::back_up, world.time_s);
  back_up_.begin(world, ladder_.back_up_times());
  return back_up(world, context);
}

// Of the obstacles before the robot; none when it knows of none.
std::optional<Point> RouteDriver::nearest_ahead(const WorldView& world) const {
  const RecoverySettings& recovery = settings_.driving.recovery;
  std::optional<Point> nearest;
  double nearest_m = world.robot.radius_m + recovery.ahead_m;
  for (const Point& p : follower_.obstacles().points()) {
    if (p.norm() >= nearest_m || std::abs(std::atan2(p.y(), p.x())) > recovery.ahead_rad) continue;
    nearest_m = p.norm();
    nearest = world.pose.T_map_robot * p;
  }
  return nearest;
}

// People who wait for the robot to leave would wait for ever: it goes where there is room, far from them. A car
// cannot: the path there would begin with an arc towards them.
bool RouteDriver::begin_yield(const WorldView& world) {
  if (world.robot.kinematics != Kinematics::differential) return false;
  const YieldSettings& yield = settings_.driving.recovery.yield;
  const Pose2& pose = world.pose.T_map_robot;
  const Point from = ladder_.blocked_by().value_or(pose * Point{world.robot.radius_m, 0.0});
  const std::vector<Point> path =
      path_aside(space(world, yield.clearance_m, Optimism::none), pose.position(), from, yield);
  if (path.size() < 2) return false;
  take(path, Leg::aside);
  BlockageLook::Target target = look_.target_at(from);
  target.at_least_s = yield.for_s;
  target.is_live = true;
  look_.aim_at(target);
  tried_ = "yielded";
  return true;
}

void RouteDriver::close_route_here(const WorldView& world, BehaviourContext& context) {
  const RouteId route = follower_.route_ahead();
  if (route == 0) return;
  requests_.close(route, world.time_s);
  context.report("closes route R" + std::to_string(route) + " for a while");
}

Status RouteDriver::back_up(const WorldView& world, BehaviourContext& context) {
  const auto is_blocked = [&](const std::vector<Point>& path, double along_m, double ahead_m) {
    return map_.is_blocked(world, path, along_m, ahead_m, world.robot.radius_m);
  };
  if (const std::optional<Twist> twist = back_up_.tick(world, is_blocked)) {
    follower_.drive_towards(*twist, world, context);
    return {StepState::running, "backing up"};
  }
  if (ladder_.without_yielding() == Recovery::back_up_and_look) {
    BlockageLook::Target target = look_.target_at(*ladder_.blocked_by());
    target.is_live = true;
    look_.aim_at(target);
    return begin_look_from_here(world, context);
  }
  set_mode(Mode::turn, world.time_s);
  turn_round_.begin(world, ladder_.round() == 1);
  return turn(world, context);
}

Status RouteDriver::turn(const WorldView& world, BehaviourContext& context) {
  const std::optional<Twist> twist = turn_round_.tick(world);
  if (!twist) {
    set_mode(Mode::plan, world.time_s);
    return plan(world, context);
  }
  follower_.drive_towards(*twist, world, context);
  return {StepState::running, "turning to look round"};
}

// The near echoes of what blocks the robot are of before; and once more when it has gone.
Status RouteDriver::begin_look_from_here(const WorldView& world, BehaviourContext& context) {
  if (look_.target().is_live) map_.forget_echoes(world);
  const Point here = world.pose.T_map_robot.position();
  const double beside_m = world.robot.radius_m + settings_.driving.look.beside_goal_m + settings_.tolerance_m;
  if (look_.target().is_goal && (here - look_.target().at).norm() < beside_m) look_.remember_stood_at(here);
  set_mode(Mode::look, world.time_s);
  return look(world, context);
}

// Faces what blocked the robot until it is gone, or for long enough.
Status RouteDriver::look(const WorldView& world, BehaviourContext& context) {
  const double looked_s = world.time_s - mode_since_s_;
  follower_.drive_towards(look_.turn(world, looked_s, settings_.driving.turn), world, context);
  const bool is_open = look_.has_opened(world, map_.echoes(), follower_.obstacles());
  const BlockageLook::Target& target = look_.target();
  if (looked_s < target.at_least_s || (!is_open && looked_s < target.at_most_s))
    return {StepState::running, "looking whether the path is free again"};
  if (target.is_live && is_open) map_.forget_echoes(world);
  map_.reopen(world.grid, look_.doubts().seen_through);
  set_mode(Mode::plan, world.time_s);
  return plan(world, context);
}

Status RouteDriver::give_up(const WorldView& world) const {
  const Point at = world.pose.T_map_robot.position();
  return {StepState::failure, "blocked at " + described(at) + ": waited, backed up, looked and planned again " +
                                  std::to_string(ladder_.round() - 1) + " times at this place, " +
                                  std::to_string(requests_.plans()) + " plans in all" +
                                  (tried_.empty() ? "" : "; " + tried_)};
}

}  // namespace cairn::behaviours
