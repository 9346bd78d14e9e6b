#include "plugins/behaviours/driving/route_driver.hpp"

#include <algorithm>
#include <limits>

#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

RouteDriver::RouteDriver(const RouteSettings& settings, std::uint64_t seed)
    : settings_(settings),
      seed_(seed),
      map_(settings.driving.local_map),
      follower_({settings.speed_mps, settings.tolerance_m}, settings.driving.follow, settings.driving.obstacles,
                ProgressChecker(settings.patience_s, settings.driving.progress)),
      requests_(settings.driving.planning, seed, settings.speed_mps),
      local_planning_(settings.driving.optimism),
      look_(settings.driving.look),
      ladder_(settings.driving.recovery, settings.rounds),
      back_up_(settings.driving.recovery.back_up),
      turn_round_(settings.driving.recovery.turn) {}

void RouteDriver::restart() {
  *this = RouteDriver(settings_, seed_);
}

Status RouteDriver::tick(const Place& goal, const WorldView& world, BehaviourContext& context) {
  const std::optional<MapExchange> exchange = map_watch_.update(world);
  if (exchange) begin_in_new_map(exchange->move);
  goal_.set(goal);
  map_.see(world);
  requests_.tick(world.time_s);
  follower_.see(world, map_);
  if (exchange && exchange->move != nullptr && mode_ != Mode::face && !keeps_route(*exchange->move, world))
    set_mode(Mode::plan, world.time_s);
  switch (mode_) {
    case Mode::plan:
      return plan(world, context);
    case Mode::travel:
      return travel(world, context);
    case Mode::back_up:
      return back_up(world, context);
    case Mode::turn:
      return turn(world, context);
    case Mode::look:
      return look(world, context);
    case Mode::face:
      break;
  }
  return face(world, context);
}

void RouteDriver::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  follower_.restart_progress();
}

void RouteDriver::begin_in_new_map(const MapMove* move) {
  if (move == nullptr) {
    const MapWatch watch = map_watch_;
    restart();
    map_watch_ = watch;
    return;
  }
  map_ = LocalMap(settings_.driving.local_map);
  follower_.forget_obstacles();
  goal_.move(*move);
  look_.move(*move);
  ladder_.move(*move);
}

// The rest of it leads where it did: to the goal, or its landmark, as these lie now.
bool RouteDriver::keeps_route(const MapMove& move, const WorldView& world) {
  if (mode_ != Mode::travel || follower_.leg() != Leg::route || follower_.optimism()) return false;
  MovedPath moved = moved_path(move, follower_.path_ahead());
  if (moved.points.empty() || moved.bend_m > kMaxBend_m) return false;
  const Landmark* const landmark = world.graph.find(goal_.landmark());
  std::optional<Pose2> end = goal_.place().pose;
  if (!end && landmark != nullptr) end = landmark->access;
  if (end && (moved.points.back() - end->position()).norm() > kMaxBend_m) return false;
  if (end) moved.points.back() = end->position();
  follower_.move_route(std::move(moved.points));
  return !follower_.is_path_blocked(world, map_, std::numeric_limits<double>::infinity());
}

Status RouteDriver::travel(const WorldView& world, BehaviourContext& context) {
  const Leg leg = follower_.leg();
  const bool looks_at_end = leg == Leg::aside || leg == Leg::to_look;
  const double at_most_s =
      leg == Leg::aside ? settings_.driving.recovery.yield.drive_at_most_s : settings_.driving.look.drive_at_most_s;
  if (looks_at_end && world.time_s - mode_since_s_ > at_most_s) return begin_look_from_here(world, context);
  if (follower_.is_stuck(world))
    return leg == Leg::aside ? begin_look_from_here(world, context) : recover(world, context);
  if (follower_.is_path_blocked(world, map_) && requests_.may_plan(world.time_s)) {
    if (looks_at_end) return begin_look_from_here(world, context);
    plan_past(world, context);
  }
  const ControlResult step = follower_.step(world, map_, context);
  if (step.state == ControlState::arrived) return arrive(world, context);
  if (step.state == ControlState::blocked) {
    if (!has_reported_wait_) context.report("waits: blocked at " + described(world.pose.T_map_robot.position()));
    has_reported_wait_ = true;
    return {StepState::running, "waiting until the path is free"};
  }
  if (follower_.leg() != Leg::route) return {StepState::running, "under way"};
  return {StepState::running, "under way", follower_.left_s(step, world)};
}

Status RouteDriver::arrive(const WorldView& world, BehaviourContext& context) {
  if (follower_.leg() == Leg::escape) {
    set_mode(Mode::plan, world.time_s);
    return {StepState::running, "has left the tight place"};
  }
  if (follower_.leg() != Leg::route) return begin_look_from_here(world, context);
  set_mode(Mode::face, world.time_s);
  return face(world, context);
}

Status RouteDriver::face(const WorldView& world, MotionRequests& context) {
  const FaceSettings& face = settings_.driving.face;
  const motion::TurnSettings& turn = settings_.driving.turn;
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  const Place& goal = goal_.place();
  const double error_rad =
      goal.pose && goal.heading_matters ? wrap_angle(goal.pose->theta_rad - world.pose.T_map_robot.theta_rad) : 0.0;
  if (!can_turn || std::abs(error_rad) <= face.faced_rad || world.time_s - mode_since_s_ > face.at_most_s)
    return {StepState::success, "there"};
  follower_.drive_towards(motion::turn_by(error_rad, motion::max_turn_radps(world.robot, turn), turn), world, context);
  return {StepState::running, "turning to its heading"};
}

}  // namespace cairn::behaviours
