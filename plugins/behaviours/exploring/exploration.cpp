#include "plugins/behaviours/exploring/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cairn::behaviours {
namespace {

constexpr double kAway_s = 0.5;  // longer than any two ticks
constexpr double kTraceTurn_rad = radians(30.0);
constexpr double kChoiceEvery_s = 2.5;
constexpr double kChoiceAtLeastApart_s = 0.5;
constexpr double kLookAround_radps = radians(45.0);
constexpr double kTaskBlockedAhead_m = 0.8;
constexpr double kOnOrbit_m = 0.5;       // from its first lookout
constexpr double kTrustedRange_m = 3.0;  // beyond it a sonar's beam is wider than a door
constexpr double kFaceTask_rad = radians(8.0);
constexpr double kFaceDwell_s = 0.6;  // one round of the sonars, about
constexpr double kOpeningDwell_s = 2.0;
constexpr double kFaceTaskAtMost_s = 8.0;
constexpr double kBackOff_mps = 0.04;  // as RouteDriver: few robots see well behind
constexpr double kBackOff_m = 0.15;
constexpr double kBackOffAtMost_s = 5.0;
constexpr double kTroubleFor_s = 60.0;
constexpr double kFailedAgain_m = 0.4;
constexpr int kMaxStuckInARow = 8;
constexpr double kExplored_m = 0.1;   // less is no exploring
constexpr double kGettingOn_m = 0.5;  // driven between two hold-ups, they are not "in a row"

}  // namespace

Exploration::Exploration(const ExploreConfig& config, const WorldView& world)
    : config_(config),
      limits_(follow_limits(world.robot, config.speed_mps)),
      begun_s_(world.time_s),
      near_echoes_(world.grid) {
  settings_.orbit = {config.orbit_distance_m, config.look_closer_m, config.largest_object_m};
  settings_.smallest_frontier_m = config.smallest_frontier_m;
  settings_.gain_m = config.gain_m;
  double farthest_m = 0.0;
  for (const SonarModel& sonar : world.robot.sonars) farthest_m = std::max(farthest_m, sonar.max_m);
  settings_.gain_range_m = std::min(farthest_m, kTrustedRange_m);
}

Status Exploration::tick(const WorldView& world, BehaviourContext& orders) {
  if (world.time_s - last_tick_s_ > kAway_s) begin_here(world);
  last_tick_s_ = world.time_s;
  remember(world);
  if (world.time_s - begun_s_ >= config_.at_most_s) return {Progress::success, "time is up: " + summary(world)};
  switch (mode_) {
    case Mode::look_around:
      return look_around(world, orders);
    case Mode::face:
      return face(world, orders);
    case Mode::back_off:
      return back_off(world, orders);
    case Mode::travel:
      break;
  }
  return travel(world, orders);
}

// Something else has driven the robot meanwhile, perhaps to where it could not get to before.
void Exploration::begin_here(const WorldView& world) {
  last_pose_ = world.pose.T_map_robot;
  near_echoes_ = NearEchoes(world.grid);
  memory_.trace.push_back(last_pose_);
  task_.reset();
  turned_rad_ = 0.0;
  stuck_in_a_row_ = 0;
  set_mode(limits_.min_turning_radius_m > 0.0 ? Mode::travel : Mode::look_around, world.time_s);
}

void Exploration::remember(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  turned_rad_ += std::abs(wrap_angle(pose.theta_rad - last_pose_.theta_rad));
  driven_m_ += (pose.position() - last_pose_.position()).norm();
  last_pose_ = pose;
  if (world.observation != nullptr) near_echoes_.see(*world.observation, pose);
  near_echoes_.stand_at(pose.position(), world.robot.radius_m);
  local_.see(world, near_echoes_);
  const Pose2& last = memory_.trace.back();
  if ((pose.position() - last.position()).norm() >= kTraceSpacing_m ||
      std::abs(wrap_angle(pose.theta_rad - last.theta_rad)) >= kTraceTurn_rad)
    memory_.trace.push_back(pose);
}

void Exploration::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  wanted_ = {};
  watch_.restart();
}

void Exploration::drive(const Twist& wanted, const WorldView& world, BehaviourContext& orders) {
  wanted_ = wanted;
  orders.drive(local_.approach(wanted, world));
}

// One turn on the spot, before the first choice: it costs no distance and opens the map all round.
Status Exploration::look_around(const WorldView& world, BehaviourContext& orders) {
  const bool held = world.time_s - mode_since_s_ > 3.0 * 2.0 * std::numbers::pi / kLookAround_radps;
  if (turned_rad_ >= 2.0 * std::numbers::pi || held) {
    looked_around_at_m_ = driven_m_;
    set_mode(Mode::travel, world.time_s);
    return travel(world, orders);
  }
  drive({0.0, std::min(kLookAround_radps, world.robot.max_w_radps)}, world, orders);
  return {Progress::running, "looking around"};
}

bool Exploration::needs_choice(const WorldView& world) const {
  if (!task_) return true;
  const double since_s = world.time_s - chosen_s_;
  if (since_s < kChoiceAtLeastApart_s) return false;
  return since_s >= kChoiceEvery_s || !still_worthwhile(*task_, world.grid);
}

bool Exploration::is_blocked(const WorldView& world) const {
  if (!task_) return false;
  const double margin_m = world.robot.radius_m + 0.5 * search_.clearance_m;
  const auto is_occupied = [&](Cell c) { return near_echoes_.is_occupied(world.grid, c); };
  const auto blocks = [&](const std::vector<Point>& path, double along_m, double ahead_m) {
    return path_is_blocked(world.grid, is_occupied, path, along_m, ahead_m, margin_m);
  };
  // A robot that already stands too near to something is on its way out and must not stop there.
  return blocks(task_->path, follow_state_.along_m, kTaskBlockedAhead_m) &&
         !blocks({world.pose.T_map_robot.position()}, 0.0, 0.0);
}

// Round the object, no longer on the way to it.
bool Exploration::is_on_orbit(const WorldView& world) const {
  return (world.pose.T_map_robot.position() - task_->lookout).norm() < kOnOrbit_m ||
         follow_state_.along_m > task_->way_m;
}

Status Exploration::travel(const WorldView& world, BehaviourContext& orders) {
  if (watch_.is_stuck(world, wanted_)) return get_unstuck(world, orders);
  const bool blocked = is_blocked(world);
  if (needs_choice(world) || (blocked && world.time_s - chosen_s_ >= kChoiceAtLeastApart_s)) {
    if (!choose(world, orders)) return nothing_left(world, orders);
  } else if (blocked) {
    drive({}, world, orders);
    return {Progress::running, "something has turned up on the path"};
  }
  FollowLimits limits = limits_;
  if (task_->kind == TaskKind::orbit && is_on_orbit(world))
    limits.speed_mps = std::min(limits.speed_mps, config_.orbit_speed_mps);
  const FollowStep step = follow(world.pose.T_map_robot, task_->path, follow_state_, limits);
  follow_state_ = step.state;
  const Point aim = point_along(task_->path, step.state.along_m + limits.lookahead_m);
  if (step.arrived) arrive(world);
  wanted_ = step.wanted;
  orders.drive(local_.steer(wanted_, aim, limits.speed_mps, world));
  return {Progress::running, task_ ? sentence_of(*task_) : "choosing what to do next"};
}

bool Exploration::is_to_be_faced() const {
  return task_->kind == TaskKind::frontier || task_->kind == TaskKind::opening;
}

void Exploration::arrive(const WorldView& world) {
  if (is_to_be_faced() && limits_.min_turning_radius_m <= 0.0) {
    set_mode(Mode::face, world.time_s);
    faced_s_ = world.time_s;
    return;
  }
  // What it arrives at again without having gone anywhere has nothing more to show, whatever is still missing of it.
  const bool is_still_here = driven_m_ - driven_when_arrived_m_ < kThere_m;
  driven_when_arrived_m_ = driven_m_;
  if (is_to_be_faced() || is_still_here) give_up(*task_, space_now(world, search_), settings_, memory_);
  task_.reset();
}

// Turns the sonars to what is still unknown; what they cannot settle from here is given up.
Status Exploration::face(const WorldView& world, BehaviourContext& orders) {
  const double error_rad = heading_error(world.pose.T_map_robot, task_->about);
  const bool has_time = world.time_s - mode_since_s_ < kFaceTaskAtMost_s;
  const double dwell_s = task_->kind == TaskKind::opening ? kOpeningDwell_s : kFaceDwell_s;
  if (std::abs(error_rad) > kFaceTask_rad && has_time) {
    faced_s_ = world.time_s;
    drive(turn_by(error_rad, limits_.max_w_radps), world, orders);
  } else if (world.time_s - faced_s_ >= dwell_s || !has_time || !still_worthwhile(*task_, world.grid)) {
    give_up(*task_, space_now(world, search_), settings_, memory_);
    task_.reset();
    set_mode(Mode::travel, world.time_s);
  }
  return {Progress::running, "facing what is still unknown"};
}

Status Exploration::get_unstuck(const WorldView& world, BehaviourContext& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  stuck_in_a_row_ = driven_m_ - driven_when_stuck_m_ < kGettingOn_m ? stuck_in_a_row_ + 1 : 1;
  driven_when_stuck_m_ = driven_m_;
  if (stuck_in_a_row_ > kMaxStuckInARow) return cannot_get_away();
  memory_.troubles.push_back({pose * Point{world.robot.radius_m, 0.0}, world.time_s + kTroubleFor_s});
  if (task_) {
    const bool again = std::any_of(failed_lookouts_.begin(), failed_lookouts_.end(),
                                   [&](const Point& p) { return (p - task_->lookout).norm() < kFailedAgain_m; });
    if (again) give_up(*task_, space_now(world, search_), settings_, memory_);
    failed_lookouts_.push_back(task_->lookout);
    task_.reset();
  }
  backed_from_ = pose.position();
  set_mode(Mode::back_off, world.time_s);
  return back_off(world, orders);
}

Status Exploration::back_off(const WorldView& world, BehaviourContext& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  const std::vector<Point> behind{pose.position(), pose * Point{-kBackOff_m, 0.0}};
  const bool is_over = (pose.position() - backed_from_).norm() >= kBackOff_m ||
                       world.time_s - mode_since_s_ > kBackOffAtMost_s ||
                       path_is_blocked(world.grid, behind, 0.5 * kBackOff_m, kBackOff_m, world.robot.radius_m);
  if (is_over) {
    set_mode(Mode::travel, world.time_s);
    return travel(world, orders);
  }
  drive({-kBackOff_mps, 0.0}, world, orders);
  return {Progress::running, "backing off"};
}

// Once more round before the end: what seems to shut the robot in may be noise.
Status Exploration::nothing_left(const WorldView& world, BehaviourContext& orders) {
  const bool can_turn = limits_.min_turning_radius_m <= 0.0;
  if (!can_turn || driven_m_ - looked_around_at_m_ < kExplored_m) return finished(world);
  // And what it remembers of near echoes may be of somebody who has gone on.
  if (is_shut_in(world)) near_echoes_ = NearEchoes(world.grid);
  turned_rad_ = 0.0;
  set_mode(Mode::look_around, world.time_s);
  return look_around(world, orders);
}

Status Exploration::finished(const WorldView& world) const {
  if (driven_m_ >= kExplored_m) return {Progress::success, "nothing left to explore: " + summary(world)};
  if (stuck_in_a_row_ > 0) return cannot_get_away();
  const FreeSpace space = space_now(world, search_);
  const Cell here = space.cell_at(last_pose_.position());
  const bool can_move = std::any_of(std::begin(kNeighbours), std::end(kNeighbours), [&](Cell step) {
    return space.reaches(here + step) || space.reaches(here + step + step);
  });
  if (can_move) return {Progress::success, "nothing left to explore: " + summary(world)};
  char text[128];
  std::snprintf(text, sizeof text, "cannot move: no known free place with %.2f m of room is in reach of (%.2f, %.2f)",
                space.min_distance_m(), last_pose_.x_m, last_pose_.y_m);
  return {Progress::failure, text};
}

Status Exploration::cannot_get_away() const {
  char text[96];
  std::snprintf(text, sizeof text, "cannot get away from (%.2f, %.2f): held back wherever it turns", last_pose_.x_m,
                last_pose_.y_m);
  return {Progress::failure, text};
}

std::string Exploration::summary(const WorldView& world) const {
  char text[96];
  std::snprintf(text, sizeof text, "%.1f %% known after %.1f m and %.0f s", 100.0 * known_ratio(world.grid), driven_m_,
                world.time_s - begun_s_);
  return text;
}

}  // namespace cairn::behaviours
