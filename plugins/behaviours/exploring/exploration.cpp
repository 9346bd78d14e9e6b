#include "plugins/behaviours/exploring/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plugins/common/motion/path.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::behaviours {
namespace {

bool can_turn(const RobotModel& robot) {
  return robot.kinematics != Kinematics::car || robot.min_turning_radius_m <= 0.0;
}

}  // namespace

Exploration::Exploration(const ExploreConfig& config, const WorldView& world)
    : config_(config),
      begun_s_(world.time_s),
      progress_(config.exploring.blocked.patience_s, config.driving.progress),
      back_up_(config.exploring.blocked.back_up),
      near_echoes_(world.grid, config.driving.local_map.echoes.near),
      obstacles_(config.driving.obstacles) {
  settings_.orbit = {config.orbit_distance_m, config.look_closer_m, config.largest_object_m, config.object};
  settings_.weights = config.exploring.weights;
  settings_.openings = config.exploring.openings;
  settings_.smallest_frontier_m = config.smallest_frontier_m;
  settings_.gain_m = config.gain_m;
  double farthest_m = 0.0;
  for (const SonarModel& sonar : world.robot.sonars) farthest_m = std::max(farthest_m, sonar.max_m);
  settings_.gain_range_m = std::min(farthest_m, config_.exploring.choice.trusted_range_m);
}

Status Exploration::tick(const WorldView& world, BehaviourContext& context) {
  if (world.time_s - last_tick_s_ > config_.exploring.motion.away_s) begin_here(world);
  last_tick_s_ = world.time_s;
  remember(world);
  if (world.time_s - begun_s_ >= config_.at_most_s) return {Progress::success, "time is up: " + summary(world)};
  switch (mode_) {
    case Mode::look_around:
      return look_around(world, context);
    case Mode::face:
      return face(world, context);
    case Mode::back_off:
      return back_off(world, context);
    case Mode::travel:
      break;
  }
  return travel(world, context);
}

// Something else has driven the robot meanwhile, perhaps to where it could not get to before.
void Exploration::begin_here(const WorldView& world) {
  last_pose_ = world.pose.T_map_robot;
  near_echoes_ = NearEchoes(world.grid, config_.driving.local_map.echoes.near);
  memory_.trace.push_back(last_pose_);
  task_.reset();
  turned_rad_ = 0.0;
  stuck_in_a_row_ = 0;
  set_mode(can_turn(world.robot) ? Mode::look_around : Mode::travel, world.time_s);
}

void Exploration::remember(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  turned_rad_ += std::abs(wrap_angle(pose.theta_rad - last_pose_.theta_rad));
  driven_m_ += (pose.position() - last_pose_.position()).norm();
  last_pose_ = pose;
  if (world.observation != nullptr) near_echoes_.see(*world.observation, pose);
  near_echoes_.stand_at(pose.position(), world.robot.radius_m);
  motion_.tick(world.time_s);
  obstacles_.see(world, near_echoes_);
  const Pose2& last = memory_.trace.back();
  if ((pose.position() - last.position()).norm() >= config_.exploring.motion.trace_apart_m ||
      std::abs(wrap_angle(pose.theta_rad - last.theta_rad)) >= config_.exploring.motion.trace_turn_rad)
    memory_.trace.push_back(pose);
}

void Exploration::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  wanted_ = {};
  progress_.restart();
}

void Exploration::drive(const Twist& wanted, const WorldView& world, BehaviourContext& context) {
  wanted_ = wanted;
  motion_.drive_towards(wanted, world, context);
}

// One turn on the spot, before the first choice: it costs no distance and opens the map all round.
Status Exploration::look_around(const WorldView& world, BehaviourContext& context) {
  const bool held =
      world.time_s - mode_since_s_ > 3.0 * 2.0 * std::numbers::pi / config_.exploring.motion.look_around_radps;
  if (turned_rad_ >= 2.0 * std::numbers::pi || held) {
    looked_around_at_m_ = driven_m_;
    set_mode(Mode::travel, world.time_s);
    return travel(world, context);
  }
  drive({0.0, std::min(config_.exploring.motion.look_around_radps, world.robot.max_w_radps)}, world, context);
  return {Progress::running, "looking around"};
}

bool Exploration::needs_choice(const WorldView& world) const {
  if (!task_) return true;
  const double since_s = world.time_s - chosen_s_;
  if (since_s < config_.exploring.choice.apart_s) return false;
  return since_s >= config_.exploring.choice.every_s || !still_worthwhile(*task_, world.grid);
}

bool Exploration::is_blocked(const WorldView& world) const {
  if (!task_) return false;
  const double margin_m = world.robot.radius_m + 0.5 * search_.clearance_m;
  const auto is_occupied = [&](Cell c) { return near_echoes_.is_occupied(world.grid, c); };
  const auto blocks = [&](const std::vector<Point>& path, double along_m, double ahead_m) {
    return path_is_blocked(world.grid, is_occupied, path, along_m, ahead_m, margin_m);
  };
  // A robot that already stands too near to something is leaving a tight place and must not stop there.
  return blocks(task_->path, path_.along_m(), config_.exploring.motion.blocked_ahead_m) &&
         !blocks({world.pose.T_map_robot.position()}, 0.0, 0.0);
}

// Round the object, no longer driving to it.
bool Exploration::is_on_orbit(const WorldView& world) const {
  return (world.pose.T_map_robot.position() - task_->lookout).norm() < config_.exploring.motion.on_orbit_m ||
         path_.along_m() > task_->path_m;
}

Status Exploration::travel(const WorldView& world, BehaviourContext& context) {
  if (progress_.is_stuck(world, wanted_)) return get_unstuck(world, context);
  const bool blocked = is_blocked(world);
  if (needs_choice(world) || (blocked && world.time_s - chosen_s_ >= config_.exploring.choice.apart_s)) {
    if (!choose(world, context)) return nothing_left(world, context);
  } else if (blocked) {
    drive({}, world, context);
    return {Progress::running, "something has turned up on the path"};
  }
  const ControlResult step = follow_path(world, context);
  if (step.state == ControlState::arrived) arrive(world);
  wanted_ = step.unhindered;
  motion_.drive(step.twist, context);
  return {Progress::running, task_ ? sentence_of(*task_) : "choosing what to do next"};
}

ControlResult Exploration::follow_path(const WorldView& world, BehaviourContext& context) {
  ControlRequest request = path_.request();
  request.speed_mps = config_.speed_mps;
  if (task_->kind == TaskKind::orbit && is_on_orbit(world)) request.speed_limit_mps = config_.orbit_speed_mps;
  request.tolerance_m = config_.exploring.motion.arrived_m;
  request.obstacles = obstacles_.points();
  request.velocity = motion_.velocity(world);
  request.period_s = motion_.period_s();
  const ControlResult result = context.control(request);
  path_.record(result);
  return result;
}

bool Exploration::is_to_be_faced() const {
  return task_->kind == TaskKind::frontier || task_->kind == TaskKind::opening;
}

void Exploration::arrive(const WorldView& world) {
  if (is_to_be_faced() && can_turn(world.robot)) {
    set_mode(Mode::face, world.time_s);
    faced_s_ = world.time_s;
    return;
  }
  // What it arrives at again without having gone anywhere has nothing more to show, whatever is still missing of it.
  const bool is_still_here = driven_m_ - driven_when_arrived_m_ < config_.exploring.choice.there_m;
  driven_when_arrived_m_ = driven_m_;
  if (is_to_be_faced() || is_still_here) give_up(*task_, space_now(world, search_), settings_, memory_);
  task_.reset();
}

// Turns the sonars to what is still unknown; what they cannot settle from here is given up.
Status Exploration::face(const WorldView& world, BehaviourContext& context) {
  const double error_rad = motion::heading_error(world.pose.T_map_robot, task_->about);
  const bool has_time = world.time_s - mode_since_s_ < config_.exploring.face.at_most_s;
  const double dwell_s =
      task_->kind == TaskKind::opening ? config_.exploring.face.opening_dwell_s : config_.exploring.face.dwell_s;
  if (std::abs(error_rad) > config_.exploring.face.faced_rad && has_time) {
    faced_s_ = world.time_s;
    drive(motion::turn_by(error_rad, motion::max_turn_radps(world.robot, config_.driving.turn), config_.driving.turn),
          world, context);
  } else if (world.time_s - faced_s_ >= dwell_s || !has_time || !still_worthwhile(*task_, world.grid)) {
    give_up(*task_, space_now(world, search_), settings_, memory_);
    task_.reset();
    set_mode(Mode::travel, world.time_s);
  }
  return {Progress::running, "facing what is still unknown"};
}

Status Exploration::get_unstuck(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  stuck_in_a_row_ = driven_m_ - driven_when_stuck_m_ < config_.exploring.blocked.progress_m ? stuck_in_a_row_ + 1 : 1;
  driven_when_stuck_m_ = driven_m_;
  if (stuck_in_a_row_ > config_.exploring.blocked.max_in_a_row) return cannot_get_away();
  memory_.troubles.push_back(
      {pose * Point{world.robot.radius_m, 0.0}, world.time_s + config_.exploring.blocked.avoid_for_s});
  if (task_) {
    const bool again = std::any_of(failed_lookouts_.begin(), failed_lookouts_.end(), [&](const Point& p) {
      return (p - task_->lookout).norm() < config_.exploring.blocked.failed_again_m;
    });
    if (again) give_up(*task_, space_now(world, search_), settings_, memory_);
    failed_lookouts_.push_back(task_->lookout);
    task_.reset();
  }
  set_mode(Mode::back_off, world.time_s);
  back_up_.begin(world);
  return back_off(world, context);
}

Status Exploration::back_off(const WorldView& world, BehaviourContext& context) {
  const auto is_blocked = [&](const std::vector<Point>& path, double along_m, double ahead_m) {
    return path_is_blocked(world.grid, path, along_m, ahead_m, world.robot.radius_m);
  };
  const std::optional<Twist> twist = back_up_.tick(world, is_blocked);
  if (!twist) {
    set_mode(Mode::travel, world.time_s);
    return travel(world, context);
  }
  drive(*twist, world, context);
  return {Progress::running, "backing off"};
}

// Once more round before the end: what seems to shut the robot in may be noise.
Status Exploration::nothing_left(const WorldView& world, BehaviourContext& context) {
  if (!can_turn(world.robot) || driven_m_ - looked_around_at_m_ < config_.exploring.motion.moved_m)
    return finished(world);
  // And what it remembers of near echoes may be of somebody who has left.
  if (is_shut_in(world)) near_echoes_ = NearEchoes(world.grid, config_.driving.local_map.echoes.near);
  turned_rad_ = 0.0;
  set_mode(Mode::look_around, world.time_s);
  return look_around(world, context);
}

Status Exploration::finished(const WorldView& world) const {
  if (driven_m_ >= config_.exploring.motion.moved_m)
    return {Progress::success, "nothing left to explore: " + summary(world)};
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
  std::snprintf(text, sizeof text, "cannot get away from (%.2f, %.2f): blocked wherever it turns", last_pose_.x_m,
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
