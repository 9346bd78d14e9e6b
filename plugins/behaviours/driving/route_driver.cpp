#include "plugins/behaviours/driving/route_driver.hpp"

#include <algorithm>

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
  goal_.set(goal);
  if (map_watch_.update(world)) begin_in_new_map(world);
  map_.see(world);
  requests_.tick(world.time_s);
  follower_.see(world, map_);
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

// Path and obstacles are where they were in the old one.
void RouteDriver::begin_in_new_map(const WorldView& world) {
  map_ = LocalMap(settings_.driving.local_map);
  if (mode_ != Mode::face) set_mode(Mode::plan, world.time_s);
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
