#include "plugins/behaviours/route_driver.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace cairn::behaviours {
namespace {

constexpr double kPlansApart_s = 1.0;
constexpr double kOwnPlansApart_s = 3.0;  // they cost more
constexpr double kBlockedAhead_m = 1.0;
constexpr double kGettingOn_m = 0.8;  // from where it was held back
constexpr int kMostHoldUps = 40;
constexpr double kWayOutTolerance_m = 0.02;
constexpr double kTrace_m = 0.1;
constexpr std::size_t kMostTrace = 400;
constexpr double kTroubleFor_s = 60.0;
constexpr double kEchoesKept_s = 15.0;
constexpr double kClosedFor_s = 60.0;
constexpr double kBackUp_mps = 0.04;  // few robots see well behind: what it touches it shall not push
constexpr double kBackUp_m = 0.2;
constexpr double kBackUpAtMost_s = 6.0;
constexpr int kFarthestBackUp = 3;  // times as far, round after round
constexpr double kTurn_rad = radians(100.0);
constexpr double kTurn_radps = radians(45.0);
constexpr double kTurnAtMost_s = 12.0;
constexpr double kLookAtLeast_s = 3.0;
constexpr double kLookAtMost_s = 25.0;  // for a door to open
// What is doubted is gone near at a speed at which touching it would do no harm.
constexpr double kDoubtNear_m = 0.25;
constexpr double kDoubtful_mps = 0.05;
constexpr double kAboutLook_m = 1.0;
constexpr double kOpened_m = 0.7;  // of cells in a row
constexpr int kSeenThrough_ticks = 10;
constexpr int kSurely_ticks = 50;
constexpr double kSweep_rad = radians(25.0);  // looked at from a little aside, too
constexpr double kSweep_s = 4.0;
constexpr int kForgetsInRound = 3;  // of the ladder: what the near echoes have said
constexpr double kFaceGoal_rad = radians(3.0);
constexpr double kFaceAtMost_s = 15.0;

std::string text_of(const Point& p) {
  char text[48];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", p.x(), p.y());
  return text;
}

}  // namespace

RouteDriver::RouteDriver(const RouteSettings& settings, std::uint64_t seed)
    : settings_(settings), seed_(seed), watch_(settings.patience_s) {}

void RouteDriver::restart() {
  *this = RouteDriver(settings_, seed_);
}

Status RouteDriver::tick(const Place& goal, const WorldView& world, Orders& orders) {
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
  hear(world);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() > kTrace_m) trace_.push_back(pose);
  if (trace_.size() > kMostTrace) trace_.erase(trace_.begin());
  std::erase_if(troubles_, [&](const TroubleSpot& spot) { return spot.until_s < world.time_s; });
  std::erase_if(closed_until_s_, [&](const auto& closed) { return closed.second < world.time_s; });
  if (round_ > 0 && mode_ == Mode::travel && leg_ == Leg::route && (pose.position() - held_at_).norm() > kGettingOn_m)
    round_ = 0;
  local_.see(world, *near_echoes_, doubted_);
}

void RouteDriver::forget_echoes(const WorldView& world) {
  near_echoes_.emplace(world.grid);
  later_echoes_.emplace(world.grid);
  echoes_since_s_ = world.time_s;
}

// Somebody who has gone on leaves near echoes that no later one takes away: they count for a while only.
void RouteDriver::hear(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  if (!near_echoes_) {
    forget_echoes(world);
    last_theta_rad_ = pose.theta_rad;
  }
  if (world.time_s - echoes_since_s_ > kEchoesKept_s) {
    near_echoes_ = std::move(later_echoes_);
    later_echoes_.emplace(world.grid);
    echoes_since_s_ = world.time_s;
  }
  for (NearEchoes* echoes : {&*near_echoes_, &*later_echoes_}) {
    if (world.observation != nullptr) echoes->see(*world.observation, pose);
    echoes->stand_at(pose.position(), world.robot.radius_m);
  }
}

void RouteDriver::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  preferred_ = {};
  watch_.restart();
}

// Something has turned up on the path: another one, if there is.
void RouteDriver::plan_past(const WorldView& world, Orders& orders) {
  if (own_trust_) {
    if (world.time_s - planned_s_ < kOwnPlansApart_s) return;
    planned_s_ = world.time_s;
    (void)plan_by_own_eyes(world, *own_trust_);  // without one it goes on: what is there the live echoes tell
    return;
  }
  const PlanResult result = ask_planner(world, orders);
  for (const RouteId route : result.blocked_routes) closed_until_s_[route] = world.time_s + kClosedFor_s;
  if (result.outcome == PlanOutcome::solved) take_route(result, world);
}

Status RouteDriver::travel(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  if (watch_.is_stuck(world, preferred_)) return held_back(world, orders);
  // One cell less than the planner's disc, so that the two never disagree about the same map.
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  const bool blocked =
      leg_ != Leg::way_out && is_blocked(world, path_, follow_state_.along_m, kBlockedAhead_m, margin_m);
  if (blocked && world.time_s - planned_s_ >= kPlansApart_s) {
    if (leg_ == Leg::to_look) {
      set_mode(Mode::look, world.time_s);
      return look(world, orders);
    }
    plan_past(world, orders);
  }
  FollowLimits limits = follow_limits(world.robot, settings_.speed_mps);
  const bool doubts_here = std::ranges::any_of(doubted_places_, [&](const Point& p) {
    return (p - pose.position()).norm() < kDoubtNear_m + world.robot.radius_m;
  });
  if (doubts_here) limits.speed_mps = std::min(limits.speed_mps, kDoubtful_mps);
  limits.arrive_m = leg_ == Leg::way_out ? kWayOutTolerance_m : settings_.tolerance_m;
  const FollowStep step = follow(pose, path_, follow_state_, limits);
  follow_state_ = step.state;
  if (step.arrived) return arrive(world, orders);
  preferred_ = step.wanted;
  const Point aim = point_along(path_, step.state.along_m + limits.lookahead_m);
  orders.drive(leg_ == Leg::way_out ? local_.approach(preferred_, world)
                                    : local_.steer(preferred_, aim, limits.speed_mps, world));
  if (local_.is_blocked()) {
    if (!said_wait_) orders.say("waits: something is in the way at " + text_of(pose.position()));
    said_wait_ = true;
    return {Progress::running, "waiting for the way to be free"};
  }
  if (leg_ != Leg::route) return {Progress::running, "under way"};
  return {Progress::running, "under way", step.left_m / limits.speed_mps};
}

Status RouteDriver::arrive(const WorldView& world, Orders& orders) {
  if (leg_ == Leg::way_out) {
    set_mode(Mode::plan, world.time_s);
    return {Progress::running, "has made room"};
  }
  if (leg_ == Leg::to_look) {
    set_mode(Mode::look, world.time_s);
    return look(world, orders);
  }
  set_mode(Mode::face, world.time_s);
  return face(world, orders);
}

// The ladder; waiting for patience_s was its first rung.
Status RouteDriver::held_back(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  held_at_ = pose.position();
  said_wait_ = false;
  stop_doubting();
  ++round_;
  ++hold_ups_;
  if (round_ > settings_.rounds || hold_ups_ > kMostHoldUps) return give_up(world);
  orders.say("held back at " + text_of(held_at_) + ": backs up, turns and plans again (" + std::to_string(round_) +
             " of " + std::to_string(settings_.rounds) + ")");
  troubles_.push_back({pose * Point{world.robot.radius_m + 0.1, 0.0}, world.time_s + kTroubleFor_s});
  if (round_ >= 2) close_route_here(world, orders);
  // Votes of before a slip may stand in the way that the map has long cleared.
  if (round_ == kForgetsInRound) forget_echoes(world);
  set_mode(Mode::back_up, world.time_s);
  return back_up(world, orders);
}

void RouteDriver::close_route_here(const WorldView& world, Orders& orders) {
  double end_m = 0.0;
  for (const PlanPiece& piece : pieces_) {
    end_m += piece.length_m;
    if (end_m < follow_state_.along_m || piece.route == 0) continue;
    closed_until_s_[piece.route] = world.time_s + kClosedFor_s;
    orders.say("closes route R" + std::to_string(piece.route) + " for a while");
    return;
  }
}

Status RouteDriver::back_up(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  const int farther = std::min(round_, kFarthestBackUp);
  const std::vector<Point> behind{pose.position(), pose * Point{-kBackUp_m, 0.0}};
  const bool is_over = (pose.position() - held_at_).norm() >= farther * kBackUp_m ||
                       world.time_s - mode_since_s_ > farther * kBackUpAtMost_s ||
                       is_blocked(world, behind, 0.5 * kBackUp_m, kBackUp_m, world.robot.radius_m);
  if (!is_over) {
    orders.drive(local_.approach({-kBackUp_mps, 0.0}, world));
    return {Progress::running, "backing up"};
  }
  set_mode(Mode::turn, world.time_s);
  // Once to each side, then all round: what the sonars have not looked at is not known any more.
  turn_left_rad_ = round_ % 3 == 0 ? 2.0 * std::numbers::pi : kTurn_rad;
  last_theta_rad_ = pose.theta_rad;
  return turn(world, orders);
}

Status RouteDriver::turn(const WorldView& world, Orders& orders) {
  const double theta_rad = world.pose.T_map_robot.theta_rad;
  turn_left_rad_ -= std::abs(wrap_angle(theta_rad - last_theta_rad_));
  last_theta_rad_ = theta_rad;
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (!can_turn || turn_left_rad_ <= 0.0 || world.time_s - mode_since_s_ > kTurnAtMost_s) {
    set_mode(Mode::plan, world.time_s);
    return plan(world, orders);
  }
  const double w_radps = std::min(kTurn_radps, world.robot.max_w_radps) * (round_ % 2 == 0 ? -1.0 : 1.0);
  orders.drive(local_.approach({0.0, w_radps}, world));
  return {Progress::running, "turning to look round"};
}

// Faces what was in the way until it is gone, or for long enough.
Status RouteDriver::look(const WorldView& world, Orders& orders) {
  const double waited_s = world.time_s - mode_since_s_;
  // Readings from one pose say the same again and again: it sweeps.
  const double aside_rad = kSweep_rad * std::sin(2.0 * std::numbers::pi * waited_s / kSweep_s);
  const double error_rad = wrap_angle(heading_error(world.pose.T_map_robot, look_at_) + aside_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (can_turn) orders.drive(local_.approach(turn_by(error_rad, kTurn_radps), world));
  const bool is_open = has_opened(world);
  const bool goes_on = waited_s < kLookAtLeast_s || (!is_open && waited_s < kLookAtMost_s);
  if (goes_on) return {Progress::running, "looking whether the way is free again"};
  set_mode(Mode::plan, world.time_s);
  return plan(world, orders);
}

// Nothing stands at the place, or the echoes go through enough of what the map holds occupied about it: a door's worth.
bool RouteDriver::has_opened(const WorldView& world) {
  const OccupancyGrid& grid = world.grid;
  const Cell at = grid.cell_at(look_at_);
  const int reach = static_cast<int>(kAboutLook_m / grid.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      if (!near_echoes_->is_occupied(grid, c)) continue;
      const LocalPlanner::Live live = local_.live_echo_at(grid.centre_of(c), world.time_s);
      if (live == LocalPlanner::Live::silent) continue;
      int& ticks = through_[c];
      ticks = std::clamp(ticks + (live == LocalPlanner::Live::there ? -1 : 1), -kSurely_ticks, kSurely_ticks);
    }
  }
  if (!near_echoes_->is_occupied(grid, at)) return true;
  return static_cast<double>(seen_through().size()) * grid.cell_m() > kOpened_m;
}

std::vector<Cell> RouteDriver::seen_through() const {
  std::vector<Cell> cells;
  for (const auto& [cell, ticks] : through_)
    if (ticks >= kSeenThrough_ticks) cells.push_back(cell);
  return cells;
}

Status RouteDriver::face(const WorldView& world, Orders& orders) {
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  const double error_rad =
      goal_.pose && goal_.heading_matters ? wrap_angle(goal_.pose->theta_rad - world.pose.T_map_robot.theta_rad) : 0.0;
  if (!can_turn || std::abs(error_rad) <= kFaceGoal_rad || world.time_s - mode_since_s_ > kFaceAtMost_s)
    return {Progress::success, "there"};
  orders.drive(local_.approach(turn_by(error_rad, follow_limits(world.robot, settings_.speed_mps).max_w_radps), world));
  return {Progress::running, "turning to its heading"};
}

Status RouteDriver::give_up(const WorldView& world) const {
  const Point at = world.pose.T_map_robot.position();
  return {Progress::failure, "held back at " + text_of(at) + ": waited, backed up, turned and planned again " +
                                 std::to_string(round_ - 1) + " times in this place, " + std::to_string(plans_) +
                                 " plans in all" + (tried_.empty() ? "" : "; " + tried_)};
}

}  // namespace cairn::behaviours
