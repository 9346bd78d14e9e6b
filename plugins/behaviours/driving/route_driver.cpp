#include "plugins/behaviours/driving/route_driver.hpp"

#include <algorithm>

#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kOwnPlansApart_s = 3.0;  // they cost more
constexpr double kBlockedAhead_m = 1.0;
constexpr double kAsideAtMost_s = 30.0;  // a car may circle round where it wants to stand
constexpr double kToLookAtMost_s = 120.0;
constexpr double kEscapeTolerance_m = 0.02;
constexpr std::size_t kMaxTrace = 400;
// What is doubted is gone near at a speed at which touching it would do no harm.
constexpr double kDoubtNear_m = 0.25;
constexpr double kDoubtful_mps = 0.05;
constexpr double kFaceGoal_rad = radians(3.0);
constexpr double kFaceAtMost_s = 15.0;

}  // namespace

RouteDriver::RouteDriver(const RouteSettings& settings, std::uint64_t seed)
    : settings_(settings), seed_(seed), watch_(settings.patience_s) {}

void RouteDriver::restart() {
  *this = RouteDriver(settings_, seed_);
}

Status RouteDriver::tick(const Place& goal, const WorldView& world, BehaviourContext& orders) {
  goal_ = goal;
  remember(world);
  switch (mode_) {
    case Mode::plan:
      return plan(world, orders);
    case Mode::travel:
      return travel(world, orders);
    case Mode::back_up:
      return back_up(world, orders);
    case Mode::turn:
      return turn(world, orders);
    case Mode::look:
      return look(world, orders);
    case Mode::face:
      break;
  }
  return face(world, orders);
}

void RouteDriver::remember(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  echoes_.see(world);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() > kTraceSpacing_m) trace_.push_back(pose);
  if (trace_.size() > kMaxTrace) trace_.erase(trace_.begin());
  for (std::vector<TroubleSpot>* spots : {&troubles_, &shut_})
    std::erase_if(*spots, [&](const TroubleSpot& spot) { return spot.until_s < world.time_s; });
  std::erase_if(closed_until_s_, [&](const auto& closed) { return closed.second < world.time_s; });
  local_.see(world, echoes_.now(), doubted_);
}

void RouteDriver::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  preferred_ = {};
  watch_.restart();
}

// Something has turned up on the path: another one, if there is.
void RouteDriver::plan_past(const WorldView& world, BehaviourContext& orders) {
  if (own_trust_) {
    if (world.time_s - planned_s_ < kOwnPlansApart_s) return;
    planned_s_ = world.time_s;
    (void)plan_by_own_eyes(world, *own_trust_);  // without one it goes on: what is there the live echoes tell
    return;
  }
  const PlanResult result = ask_planner(world, orders);
  if (result.outcome == PlanOutcome::solved) take_route(result, world);
}

Status RouteDriver::travel(const WorldView& world, BehaviourContext& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  const bool is_late = world.time_s - mode_since_s_ > (leg_ == Leg::aside ? kAsideAtMost_s : kToLookAtMost_s);
  if ((leg_ == Leg::aside || leg_ == Leg::to_look) && is_late) return begin_look_from_here(world, orders);
  if (watch_.is_stuck(world, preferred_))
    return leg_ == Leg::aside ? begin_look_from_here(world, orders) : progress_checker(world, orders);
  // One cell less than the planner's disc, so that the two never disagree about the same map.
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  const bool blocked =
      leg_ != Leg::escape_path && is_blocked(world, path_, follow_state_.along_m, kBlockedAhead_m, margin_m);
  if (blocked && world.time_s - planned_s_ >= kPlansApart_s) {
    if (leg_ == Leg::to_look || leg_ == Leg::aside) return begin_look_from_here(world, orders);
    plan_past(world, orders);
  }
  FollowLimits limits = follow_limits(world.robot, settings_.speed_mps);
  const bool doubts_here = std::ranges::any_of(doubted_places_, [&](const Point& p) {
    return (p - pose.position()).norm() < kDoubtNear_m + world.robot.radius_m;
  });
  if (doubts_here) limits.speed_mps = std::min(limits.speed_mps, kDoubtful_mps);
  limits.arrive_m = leg_ == Leg::escape_path ? kEscapeTolerance_m : settings_.tolerance_m;
  const FollowStep step = follow(pose, path_, follow_state_, limits);
  follow_state_ = step.state;
  if (step.arrived) return arrive(world, orders);
  preferred_ = step.wanted;
  const Point aim = point_along(path_, step.state.along_m + limits.lookahead_m);
  orders.drive(leg_ == Leg::escape_path ? local_.approach(preferred_, world)
                                        : local_.steer(preferred_, aim, limits.speed_mps, world));
  if (local_.is_blocked()) {
    if (!said_wait_) orders.say("waits: something is in the way at " + described(pose.position()));
    said_wait_ = true;
    return {Progress::running, "waiting for the way to be free"};
  }
  if (leg_ != Leg::route) return {Progress::running, "under way"};
  return {Progress::running, "under way", step.left_m / limits.speed_mps};
}

Status RouteDriver::arrive(const WorldView& world, BehaviourContext& orders) {
  if (leg_ == Leg::escape_path) {
    set_mode(Mode::plan, world.time_s);
    return {Progress::running, "has made room"};
  }
  if (leg_ == Leg::to_look || leg_ == Leg::aside) return begin_look_from_here(world, orders);
  set_mode(Mode::face, world.time_s);
  return face(world, orders);
}

Status RouteDriver::face(const WorldView& world, BehaviourContext& orders) {
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  const double error_rad =
      goal_.pose && goal_.heading_matters ? wrap_angle(goal_.pose->theta_rad - world.pose.T_map_robot.theta_rad) : 0.0;
  if (!can_turn || std::abs(error_rad) <= kFaceGoal_rad || world.time_s - mode_since_s_ > kFaceAtMost_s)
    return {Progress::success, "there"};
  orders.drive(local_.approach(turn_by(error_rad, follow_limits(world.robot, settings_.speed_mps).max_w_radps), world));
  return {Progress::running, "turning to its heading"};
}

}  // namespace cairn::behaviours
