// How the route driver gets on again when it is held back: its ladder, and looking whether the way is free.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

constexpr int kMaxBlockages = 40;
constexpr double kRouteTroubleFor_s = 60.0;
constexpr double kShutFor_s = 200.0;  // long enough to try the other gaps of a wall that sonars leak through
constexpr double kBackUp_mps = 0.04;  // few robots see well behind: what it touches it shall not push
constexpr double kBackUp_m = 0.2;
constexpr double kBackUpAtMost_s = 6.0;
constexpr int kFarthestBackUp = 3;  // times as far, round after round
constexpr double kTurn_rad = radians(100.0);
constexpr double kTurn_radps = radians(45.0);
constexpr double kTurnAtMost_s = 12.0;
constexpr double kAboutLook_m = 1.0;
constexpr double kOpened_m = 0.7;  // of cells in a row
constexpr int kSeenThrough_ticks = 10;
constexpr int kSurely_ticks = 50;
constexpr double kSweep_rad = radians(25.0);  // looked at from a little aside, too
constexpr double kSweep_s = 4.0;
constexpr double kSamePlace_m = 0.8;
constexpr double kAround_m = 0.5;
constexpr double kAhead_rad = radians(60.0);
constexpr double kMinAside_m = 0.8;  // from what is in the way, less what the way costs
constexpr double kMaxAside_m = 2.5;
constexpr double kWayForRoom = 0.3;
constexpr double kAsideClearance_m = 0.08;
constexpr double kYieldFor_s = 8.0;

// Waiting for what moves by itself comes before what costs a detour: rounds 2, 4, 6 against 3, 5.
bool looks_in(int round) {
  return round % 2 == 0;
}
bool yields(int round) {
  return round >= 3 && !looks_in(round);
}

}  // namespace

// The ladder; waiting for patience_s was its first rung.
Status RouteDriver::progress_checker(const WorldView& world, BehaviourContext& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  if ((pose.position() - held_at_).norm() > kSamePlace_m) round_ = 0;
  held_at_ = pose.position();
  held_by_ = nearest_ahead(world);
  said_wait_ = false;
  stop_doubting();
  ++round_;
  ++hold_ups_;
  if (round_ > settings_.rounds || hold_ups_ > kMaxBlockages) return give_up(world);
  const std::string where = "held back at " + described(held_at_) +
                            (held_by_ ? " by what is at " + described(*held_by_) : "") + " (" + std::to_string(round_) +
                            " of " + std::to_string(settings_.rounds) + "): ";
  troubles_.push_back({pose * Point{world.robot.radius_m + 0.1, 0.0}, world.time_s + kRouteTroubleFor_s});
  if (own_trust_ >= Trust::only_solid && held_by_) shut_.push_back({*held_by_, world.time_s + kShutFor_s});
  if (round_ >= 2) close_route_here(world, orders);
  if (yields(round_) && begin_aside(world)) {
    orders.say(where + "makes way");
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "making way"};
  }
  orders.say(where + (looks_in(round_) && held_by_ ? "backs up and looks" : "backs up and turns"));
  set_mode(Mode::back_up, world.time_s);
  return back_up(world, orders);
}

// Of the live obstacles before the robot; none when it knows of none.
std::optional<Point> RouteDriver::nearest_ahead(const WorldView& world) const {
  std::optional<Point> nearest;
  double nearest_m = world.robot.radius_m + kAround_m;
  for (const Point& p : local_.obstacles()) {
    if (p.norm() >= nearest_m || std::abs(std::atan2(p.y(), p.x())) > kAhead_rad) continue;
    nearest_m = p.norm();
    nearest = world.pose.T_map_robot * p;
  }
  return nearest;
}

// People who wait for the robot to go on are waited for in vain: it goes where there is room, far from them. A car
// cannot: the way there would begin with an arc towards them.
bool RouteDriver::begin_aside(const WorldView& world) {
  if (world.robot.kinematics != Kinematics::differential) return false;
  const Point from = held_by_.value_or(world.pose.T_map_robot * Point{world.robot.radius_m, 0.0});
  const FreeSpace space = space_now(world, kAsideClearance_m, Trust::all);
  const Cell here = space.cell_at(world.pose.T_map_robot.position());
  const int reach = static_cast<int>(kMaxAside_m / space.cell_m());
  std::optional<Cell> best;
  double best_m = kMinAside_m;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = here + Cell{dx, dy};
      if (!space.reaches(c) || space.cost_m(c) > kMaxAside_m) continue;
      const double away_m = (space.centre_of(c) - from).norm() - kWayForRoom * space.cost_m(c);
      if (away_m <= best_m) continue;
      best_m = away_m;
      best = c;
    }
  }
  if (!best) return false;
  const std::vector<Point> path = space.path_to(*best);
  if (path.size() < 2) return false;
  take_path(path, Leg::aside);
  look_ = {.at = from, .at_least_s = kYieldFor_s, .is_live = true, .through = {}};
  tried_ = "made way";
  return true;
}

void RouteDriver::close_route_here(const WorldView& world, BehaviourContext& orders) {
  double end_m = 0.0;
  for (const PathSegment& piece : segments_) {
    end_m += piece.length_m;
    if (end_m < follow_state_.along_m || piece.route == 0) continue;
    closed_until_s_[piece.route] = world.time_s + kClosedFor_s;
    orders.say("closes route R" + std::to_string(piece.route) + " for a while");
    return;
  }
}

Status RouteDriver::back_up(const WorldView& world, BehaviourContext& orders) {
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
  if (looks_in(round_) && held_by_) {
    look_ = {.at = *held_by_, .is_live = true, .through = {}};
    return begin_look_from_here(world, orders);
  }
  set_mode(Mode::turn, world.time_s);
  turn_left_rad_ = round_ == 1 ? kTurn_rad : 2.0 * std::numbers::pi;
  last_theta_rad_ = pose.theta_rad;
  return turn(world, orders);
}

Status RouteDriver::turn(const WorldView& world, BehaviourContext& orders) {
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

// What the near echoes have said of what holds it back is of before; and once more when that has gone.
Status RouteDriver::begin_look_from_here(const WorldView& world, BehaviourContext& orders) {
  if (look_.is_live) echoes_.forget(world);
  const Point here = world.pose.T_map_robot.position();
  if (look_.is_goal && (here - look_.at).norm() < world.robot.radius_m + kBesideGoal_m + settings_.tolerance_m)
    beside_goal_.push_back(here);
  set_mode(Mode::look, world.time_s);
  return look(world, orders);
}

// Faces what was in the way until it is gone, or for long enough.
Status RouteDriver::look(const WorldView& world, BehaviourContext& orders) {
  const double waited_s = world.time_s - mode_since_s_;
  // Readings from one pose say the same again and again: it sweeps.
  const double aside_rad = kSweep_rad * std::sin(2.0 * std::numbers::pi * waited_s / kSweep_s);
  const double error_rad = wrap_angle(heading_error(world.pose.T_map_robot, look_.at) + aside_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  orders.drive(
      local_.approach(can_turn ? turn_by(error_rad, std::min(kTurn_radps, world.robot.max_w_radps)) : Twist{}, world));
  const bool is_open = has_opened(world);
  const bool goes_on = waited_s < look_.at_least_s || (!is_open && waited_s < look_.at_most_s);
  if (goes_on) return {Progress::running, "looking whether the way is free again"};
  if (look_.is_live && is_open) echoes_.forget(world);
  set_mode(Mode::plan, world.time_s);
  return plan(world, orders);
}

// What held it back has gone when echoes come from behind it. What the map has there is gone when nothing stands at the
// place, or the echoes go through enough of what is held occupied about it: a door's worth.
bool RouteDriver::has_opened(const WorldView& world) {
  const OccupancyGrid& grid = world.grid;
  const Cell at = grid.cell_at(look_.at);
  const int reach = static_cast<int>(kAboutLook_m / grid.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      if (c != at && !echoes_.now().is_occupied(grid, c)) continue;
      const LocalPlanner::Live live = local_.live_echo_at(grid.centre_of(c), world.time_s);
      if (live == LocalPlanner::Live::silent) continue;
      int& ticks = look_.through[c];
      ticks = std::clamp(ticks + (live == LocalPlanner::Live::there ? -1 : 1), -kSurely_ticks, kSurely_ticks);
    }
  }
  if (look_.is_live) return is_seen_through(at);
  if (!echoes_.now().is_occupied(grid, at)) return true;
  return static_cast<double>(seen_through().size()) * grid.cell_m() > kOpened_m;
}

bool RouteDriver::is_seen_through(Cell cell) const {
  const auto found = look_.through.find(cell);
  return found != look_.through.end() && found->second >= kSeenThrough_ticks;
}

std::vector<Cell> RouteDriver::seen_through() const {
  std::vector<Cell> cells;
  for (const auto& [cell, ticks] : look_.through)
    if (ticks >= kSeenThrough_ticks) cells.push_back(cell);
  return cells;
}

Status RouteDriver::give_up(const WorldView& world) const {
  const Point at = world.pose.T_map_robot.position();
  return {Progress::failure, "held back at " + described(at) + ": waited, backed up, looked and planned again " +
                                 std::to_string(round_ - 1) + " times in this place, " + std::to_string(plans_) +
                                 " plans in all" + (tried_.empty() ? "" : "; " + tried_)};
}

}  // namespace cairn::behaviours
