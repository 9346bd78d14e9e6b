// How the route driver gets on again when it is held back: its ladder, and looking whether the way is free.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/behaviours/place_name.hpp"
#include "plugins/behaviours/route_driver.hpp"

namespace cairn::behaviours {
namespace {

constexpr int kMostHoldUps = 40;
constexpr double kTroubleFor_s = 60.0;
constexpr double kBackUp_mps = 0.04;  // few robots see well behind: what it touches it shall not push
constexpr double kBackUp_m = 0.2;
constexpr double kBackUpAtMost_s = 6.0;
constexpr int kFarthestBackUp = 3;  // times as far, round after round
constexpr double kTurn_rad = radians(100.0);
constexpr double kTurn_radps = radians(45.0);
constexpr double kTurnAtMost_s = 12.0;
constexpr double kLookAtMost_s = 25.0;  // for a door to open
constexpr double kAboutLook_m = 1.0;
constexpr double kOpened_m = 0.7;  // of cells in a row
constexpr int kSeenThrough_ticks = 10;
constexpr int kSurely_ticks = 50;
constexpr double kSweep_rad = radians(25.0);  // looked at from a little aside, too
constexpr double kSweep_s = 4.0;
constexpr double kSamePlace_m = 0.8;
constexpr double kClosedFor_s = 60.0;
constexpr double kAhead_m = 0.1;
constexpr double kAround_m = 0.5;
constexpr double kAhead_rad = radians(60.0);
constexpr double kLeastAside_m = 0.8;  // from what is in the way, less what the way costs
constexpr double kMostAside_m = 2.5;
constexpr double kWayForRoom = 0.3;
constexpr double kAsideClearance_m = 0.08;
constexpr double kMakeWayFor_s = 8.0;

// In these rounds of the ladder.
bool makes_way(int round) {
  return round >= 3 && round % 2 == 1;
}

}  // namespace

// The ladder; waiting for patience_s was its first rung.
Status RouteDriver::held_back(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  if ((pose.position() - held_at_).norm() > kSamePlace_m) round_ = 0;
  held_at_ = pose.position();
  said_wait_ = false;
  stop_doubting();
  ++round_;
  ++hold_ups_;
  if (round_ > settings_.rounds || hold_ups_ > kMostHoldUps) return give_up(world);
  const Point in_the_way = nearest_ahead(world);
  look_ = {.at = in_the_way, .is_live = true, .through = {}};
  orders.say("held back at " + described(held_at_) + " by what is at " + described(in_the_way) + " (" +
             std::to_string(round_) + " of " + std::to_string(settings_.rounds) + ")");
  troubles_.push_back({pose * Point{world.robot.radius_m + 0.1, 0.0}, world.time_s + kTroubleFor_s});
  if (round_ >= 2) close_route_here(world, orders);
  if (makes_way(round_) && begin_aside(world)) {
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "making way"};
  }
  set_mode(Mode::back_up, world.time_s);
  return back_up(world, orders);
}

// Of the live obstacles before the robot; a little ahead when it knows of none.
Point RouteDriver::nearest_ahead(const WorldView& world) const {
  Point nearest{world.robot.radius_m + kAhead_m, 0.0};
  double nearest_m = world.robot.radius_m + kAround_m;
  for (const Point& p : local_.obstacles()) {
    if (p.norm() >= nearest_m || std::abs(std::atan2(p.y(), p.x())) > kAhead_rad) continue;
    nearest_m = p.norm();
    nearest = p;
  }
  return world.pose.T_map_robot * nearest;
}

// People who wait for the robot to go on are waited for in vain: it goes where there is room, far from them.
bool RouteDriver::begin_aside(const WorldView& world) {
  const FreeSpace space = space_now(world, kAsideClearance_m, Trust::all);
  const Cell here = space.cell_at(world.pose.T_map_robot.position());
  const int reach = static_cast<int>(kMostAside_m / space.cell_m());
  std::optional<Cell> best;
  double best_m = kLeastAside_m;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = here + Cell{dx, dy};
      if (!space.reaches(c) || space.cost_m(c) > kMostAside_m) continue;
      const double away_m = (space.centre_of(c) - look_.at).norm() - kWayForRoom * space.cost_m(c);
      if (away_m <= best_m) continue;
      best_m = away_m;
      best = c;
    }
  }
  if (!best) return false;
  path_ = space.path_to(*best);
  if (path_.size() < 2) return false;
  follow_state_ = {};
  leg_ = Leg::aside;
  look_.at_least_s = kMakeWayFor_s;
  return true;
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
  if (round_ % 2 == 0) {
    set_mode(Mode::look, world.time_s);
    return look(world, orders);
  }
  set_mode(Mode::turn, world.time_s);
  // What the sonars have not looked at is not known any more.
  turn_left_rad_ = round_ == 1 ? kTurn_rad : 2.0 * std::numbers::pi;
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
  orders.drive(local_.approach({0.0, std::min(kTurn_radps, world.robot.max_w_radps)}, world));
  return {Progress::running, "turning to look round"};
}

// Faces what was in the way until it is gone, or for long enough.
Status RouteDriver::look(const WorldView& world, Orders& orders) {
  const double waited_s = world.time_s - mode_since_s_;
  // Readings from one pose say the same again and again: it sweeps.
  const double aside_rad = kSweep_rad * std::sin(2.0 * std::numbers::pi * waited_s / kSweep_s);
  const double error_rad = wrap_angle(heading_error(world.pose.T_map_robot, look_.at) + aside_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (can_turn) orders.drive(local_.approach(turn_by(error_rad, kTurn_radps), world));
  const bool is_open = has_opened(world);
  const bool goes_on = waited_s < look_.at_least_s || (!is_open && waited_s < kLookAtMost_s);
  if (goes_on) return {Progress::running, "looking whether the way is free again"};
  if (look_.is_live) forget_echoes(world);
  set_mode(Mode::plan, world.time_s);
  return plan(world, orders);
}

// Nothing stands at the place, or the echoes go through it, or through enough of what the map holds occupied about it:
// a door's worth. What the map alone has there may be drawn thick: only a live obstacle is gone with its own cell.
bool RouteDriver::has_opened(const WorldView& world) {
  const OccupancyGrid& grid = world.grid;
  const Cell at = grid.cell_at(look_.at);
  const int reach = static_cast<int>(kAboutLook_m / grid.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      if (!near_echoes_->is_occupied(grid, c)) continue;
      const LocalPlanner::Live live = local_.live_echo_at(grid.centre_of(c), world.time_s);
      if (live == LocalPlanner::Live::silent) continue;
      int& ticks = look_.through[c];
      ticks = std::clamp(ticks + (live == LocalPlanner::Live::there ? -1 : 1), -kSurely_ticks, kSurely_ticks);
    }
  }
  if (!near_echoes_->is_occupied(grid, at)) return true;
  const auto there = look_.through.find(at);
  if (look_.is_live && there != look_.through.end() && there->second >= kSeenThrough_ticks) return true;
  return static_cast<double>(seen_through().size()) * grid.cell_m() > kOpened_m;
}

std::vector<Cell> RouteDriver::seen_through() const {
  std::vector<Cell> cells;
  for (const auto& [cell, ticks] : look_.through)
    if (ticks >= kSeenThrough_ticks) cells.push_back(cell);
  return cells;
}

Status RouteDriver::give_up(const WorldView& world) const {
  const Point at = world.pose.T_map_robot.position();
  return {Progress::failure, "held back at " + described(at) + ": waited, backed up, turned and planned again " +
                                 std::to_string(round_ - 1) + " times in this place, " + std::to_string(plans_) +
                                 " plans in all" + (tried_.empty() ? "" : "; " + tried_)};
}

}  // namespace cairn::behaviours
