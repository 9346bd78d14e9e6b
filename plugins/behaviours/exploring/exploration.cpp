#include "plugins/behaviours/exploring/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "plugins/common/motion/path.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::behaviours {
namespace {

// No home was ever known to so large a share while a room of it was missing; cracks beside furniture are what is left.
constexpr double kAllRooms_ratio = 0.97;

bool can_turn(const RobotModel& robot) {
  return robot.kinematics != Kinematics::car || robot.min_turning_radius_m <= 0.0;
}

std::string width_of(const HeardOpening& heard) {
  if (!heard.is_heard) return "no echo";
  char text[32];
  std::snprintf(text, sizeof text, "heard %.2f m wide", heard.width_m);
  return text;
}

}  // namespace

Exploration::Exploration(const ExploreConfig& config, const WorldView& world)
    : config_(config),
      chooser_(config, world),
      follower_(config),
      drive_(config),
      blockages_(config.exploring.blocked),
      back_up_(config.exploring.blocked.back_up),
      begun_s_(world.time_s) {}

Status Exploration::tick(const WorldView& world, BehaviourContext& context) {
  if (const auto exchange = map_watch_.update(world)) begin_in_new_map(world, exchange->move);
  if (world.time_s - last_tick_s_ > config_.exploring.motion.away_s) begin_here(world);
  last_tick_s_ = world.time_s;
  has_nothing_left_ = false;
  travelled_.add(world.pose.T_map_robot);
  chooser_.see(world);
  follower_.see(world, chooser_.near_echoes());
  if (world.time_s - begun_s_ >= config_.at_most_s) return {StepState::success, "time is up: " + summary(world)};
  switch (mode_) {
    case Mode::look_around:
      return look_around(world, context);
    case Mode::face:
      return face(world, context);
    case Mode::back_off:
      return back_off(world, context);
    case Mode::passage:
      return pass(world, context);
    case Mode::travel:
      break;
  }
  return travel(world, context);
}

// Something else has driven the robot meanwhile, perhaps to where it could not get to before.
void Exploration::begin_here(const WorldView& world) {
  travelled_.T_map_last = world.pose.T_map_robot;
  travelled_.turned_rad = 0.0;
  chooser_.begin_here(world);
  blockages_.restart();
  task_.reset();
  set_mode(can_turn(world.robot) ? Mode::look_around : Mode::travel, world.time_s);
}

// Where it was going is elsewhere now; it has looked around already.
void Exploration::begin_in_new_map(const WorldView& world, const MapMove* move) {
  chooser_.begin_in_new_map(world, move);
  begin_here(world);
  follower_.forget_obstacles();
  blockages_.move(move);
  if (move != nullptr) move_place(*move, announced_);
  set_mode(Mode::travel, world.time_s);
}

void Exploration::set_mode(Mode mode, double time_s) {
  mode_ = mode;
  mode_since_s_ = time_s;
  follower_.restart_progress();
}

// One turn on the spot, before the first choice: it costs no distance and opens the map all round.
Status Exploration::look_around(const WorldView& world, BehaviourContext& context) {
  const double at_most_s = config_.exploring.motion.look_around_max_turns * 2.0 * std::numbers::pi /
                           config_.exploring.motion.look_around_radps;
  const bool is_late = world.time_s - mode_since_s_ > at_most_s;
  if (travelled_.turned_rad >= 2.0 * std::numbers::pi || is_late) {
    looked_around_at_m_ = travelled_.driven_m;
    set_mode(Mode::travel, world.time_s);
    return travel(world, context);
  }
  const double turn_radps = std::min(config_.exploring.motion.look_around_radps, world.robot.max_w_radps);
  follower_.drive({0.0, turn_radps}, world, context);
  return {StepState::running, "looking around"};
}

bool Exploration::needs_choice(const WorldView& world) const {
  if (!task_) return true;
  const double since_s = world.time_s - chosen_s_;
  if (since_s < config_.exploring.choice.apart_s) return false;
  return since_s >= config_.exploring.choice.every_s ||
         !still_worthwhile(*task_, world.grid, config_.exploring.weights);
}

bool Exploration::choose(const WorldView& world, BehaviourContext& context) {
  chosen_s_ = world.time_s;
  task_ = chooser_.choose(world, task_);
  if (!task_) return false;
  follower_.take(task_->path);
  if (task_->kind == TaskKind::orbit && (task_->about - announced_).norm() > config_.orbit_distance_m) {
    announced_ = task_->about;
    context.report(sentence_of(*task_));
  }
  return true;
}

// Round the object, no longer driving to it.
bool Exploration::is_on_orbit(const WorldView& world) const {
  return (world.pose.T_map_robot.position() - task_->lookout).norm() < config_.exploring.motion.on_orbit_m ||
         follower_.along_m() > task_->path_m;
}

Status Exploration::travel(const WorldView& world, BehaviourContext& context) {
  if (follower_.is_stuck(world)) return get_unstuck(world, context);
  const bool blocked = task_ && chooser_.is_blocked(world, task_->path, follower_.along_m());
  if (needs_choice(world) || (blocked && world.time_s - chosen_s_ >= config_.exploring.choice.apart_s)) {
    if (!choose(world, context)) return nothing_left(world, context);
  } else if (blocked) {
    follower_.drive({}, world, context);
    return {StepState::running, "something has turned up on the path"};
  }
  const bool is_orbit = task_->kind == TaskKind::orbit && is_on_orbit(world);
  const double speed_limit_mps = is_orbit ? config_.orbit_speed_mps : std::numeric_limits<double>::infinity();
  const ControlResult step = follower_.step(speed_limit_mps, world, context);
  if (step.state == ControlState::arrived) arrive(world);
  return {StepState::running, task_ ? sentence_of(*task_) : "choosing what to do next"};
}

void Exploration::begin_passage(const WorldView& world) {
  drive_.begin(*task_, world);
  chooser_.begin_passage();
  set_mode(Mode::passage, world.time_s);
}

Status Exploration::pass(const WorldView& world, BehaviourContext& context) {
  const Status status = drive_.tick(*task_, world, context);
  if (status.state == StepState::running) return {StepState::running, sentence_of(*task_) + ": " + status.reason};
  const bool has_passed = status.state == StepState::success;
  if (task_->kind == TaskKind::way_back && !has_passed) return cannot_get_away();
  context.report(sentence_of(*task_) + (has_passed ? ": passed" : ": " + status.reason));
  chooser_.record_passage(*task_, has_passed, status.reason);
  task_.reset();
  set_mode(Mode::travel, world.time_s);
  return {StepState::running, "choosing what to do next"};
}

void Exploration::arrive(const WorldView& world) {
  if (is_faced(task_->kind) && can_turn(world.robot)) {
    set_mode(Mode::face, world.time_s);
    faced_s_ = world.time_s;
    is_faced_ = false;
    if (task_->kind == TaskKind::opening) chooser_.begin_look(world, task_->about);
    return;
  }
  if (task_->kind == TaskKind::passage) return begin_passage(world);
  // What it arrives at again without having gone anywhere has nothing more to show, whatever is still missing of it.
  const bool is_still_here = travelled_.driven_m - arrived_at_m_ < config_.exploring.choice.there_m;
  arrived_at_m_ = travelled_.driven_m;
  if (is_faced(task_->kind) || is_still_here) chooser_.give_up(*task_, world);
  task_.reset();
}

// Turns the sonars to what is still unknown; what they cannot settle from here is given up.
Status Exploration::face(const WorldView& world, BehaviourContext& context) {
  const bool is_opening = task_->kind == TaskKind::opening;
  const motion::TurnSettings& turn = config_.driving.turn;
  const double error_rad = motion::heading_error(world.pose.T_map_robot, task_->about);
  const bool has_time = world.time_s - mode_since_s_ < config_.exploring.face.at_most_s;
  const double dwell_s = is_opening ? config_.exploring.face.opening_dwell_s : config_.exploring.face.dwell_s;
  const bool is_sweeping = is_opening && is_faced_;
  if (is_opening) chooser_.look_through(world, task_->about);
  if (std::abs(error_rad) > config_.exploring.face.faced_rad && has_time && !is_sweeping) {
    faced_s_ = world.time_s;
    follower_.drive(motion::turn_by(error_rad, motion::max_turn_radps(world.robot, turn), turn), world, context);
  } else if (world.time_s - faced_s_ >= dwell_s || !has_time ||
             !still_worthwhile(*task_, world.grid, config_.exploring.weights)) {
    end_facing(world, context);
  } else if (is_opening) {
    is_faced_ = true;
    const double phase_rad = 2.0 * std::numbers::pi * (world.time_s - faced_s_) / std::max(dwell_s, 0.1);
    const double off_rad = error_rad + config_.exploring.face.sweep_rad * std::sin(phase_rad);
    follower_.drive(motion::turn_by(off_rad, motion::max_turn_radps(world.robot, turn), turn), world, context);
  }
  return {StepState::running, "facing what is still unknown"};
}

void Exploration::end_facing(const WorldView& world, BehaviourContext& context) {
  if (task_->kind != TaskKind::opening) {
    chooser_.give_up(*task_, world);
    task_.reset();
  } else {
    context.report(sentence_of(*task_) + ": " + width_of(chooser_.heard()));
    task_ = chooser_.end_look(*task_, world);
    if (task_) return begin_passage(world);
  }
  set_mode(Mode::travel, world.time_s);
}

Status Exploration::get_unstuck(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  const ExploreBlockedSettings& blocked = config_.exploring.blocked;
  blockages_.add(travelled_.driven_m);
  if (blockages_.is_too_many()) return turn_back(world);
  chooser_.avoid(pose * Point{world.robot.radius_m, 0.0}, world.time_s + blocked.avoid_for_s);
  if (task_) {
    if (blockages_.add_failed(task_->lookout)) chooser_.give_up(*task_, world);
    task_.reset();
  }
  set_mode(Mode::back_off, world.time_s);
  back_up_.begin(world);
  return back_off(world, context);
}

// What it has driven through was free, whatever the map has made of it since.
Status Exploration::turn_back(const WorldView& world) {
  const double since_m = travelled_.driven_m - turned_back_at_m_;
  std::optional<ExploreTask> task = chooser_.way_back(world);
  if (!task || since_m < 3.0 * config_.exploring.blocked.way_back_m) return cannot_get_away();
  turned_back_at_m_ = travelled_.driven_m;
  blockages_.restart();
  task_ = std::move(task);
  begin_passage(world);
  return {StepState::running, sentence_of(*task_)};
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
  follower_.drive(*twist, world, context);
  return {StepState::running, "backing off"};
}

// Once more round before the end: what seems to shut the robot in may be noise.
Status Exploration::nothing_left(const WorldView& world, BehaviourContext& context) {
  if (chooser_.retry_passages()) return {StepState::running, "trying once more what it did not get through"};
  if (!can_turn(world.robot) || travelled_.driven_m - looked_around_at_m_ < config_.exploring.motion.moved_m)
    return finished(world);
  // And what it remembers of near echoes may be of somebody who has left.
  if (chooser_.is_shut_in(world)) chooser_.forget_echoes(world);
  travelled_.turned_rad = 0.0;
  set_mode(Mode::look_around, world.time_s);
  return look_around(world, context);
}

Status Exploration::finished(const WorldView& world) {
  if (travelled_.driven_m >= config_.exploring.motion.moved_m) return explored(world);
  if (blockages_.is_any()) return cannot_get_away();
  const FreeSpace space = chooser_.space(world);
  const Cell here = space.cell_at(world.pose.T_map_robot.position());
  const bool can_move = std::any_of(std::begin(kNeighbours), std::end(kNeighbours), [&](Cell step) {
    return space.reaches(here + step) || space.reaches(here + step + step);
  });
  if (can_move) return explored(world);
  char text[128];
  std::snprintf(text, sizeof text, "cannot move: no known free place with %.2f m of room is in reach of (%.2f, %.2f)",
                space.min_distance_m(), travelled_.T_map_last.x_m, travelled_.T_map_last.y_m);
  return {StepState::failure, text};
}

// A failure when the robot has not got into places that it should fit into, and so much is unknown that it may be a
// room.
Status Exploration::explored(const WorldView& world) {
  has_nothing_left_ = true;
  chooser_.settle_known(world);
  const std::vector<NotEntered> left = chooser_.not_entered(world);
  std::string text;
  for (const NotEntered& opening : left) text += (text.empty() ? "; not entered: " : ", ") + sentence_of(opening);
  const bool is_half_known = chooser_.known_ratio() < std::min(config_.until_known_ratio, kAllRooms_ratio);
  const bool has_missed = std::ranges::any_of(left, [](const NotEntered& opening) { return !opening.is_too_narrow; });
  if (is_half_known && has_missed) return {StepState::failure, "openings not entered: " + summary(world) + text};
  return {StepState::success, "nothing left to explore: " + summary(world) + text};
}

Status Exploration::cannot_get_away() const {
  char text[96];
  std::snprintf(text, sizeof text, "cannot get away from (%.2f, %.2f): blocked wherever it turns",
                travelled_.T_map_last.x_m, travelled_.T_map_last.y_m);
  return {StepState::failure, text};
}

std::string Exploration::summary(const WorldView& world) const {
  char text[96];
  std::snprintf(text, sizeof text, "%.1f %% known after %.1f m and %.0f s", 100.0 * chooser_.known_ratio(),
                travelled_.driven_m, world.time_s - begun_s_);
  return text;
}

}  // namespace cairn::behaviours
