#include "plugins/behaviours/exploring/passages/passage_drive.hpp"

#include <algorithm>
#include <cstdio>

namespace cairn::behaviours {
namespace {

// The last of the speeds for what has none of its own.
double speed_of(const PassageDriveSettings& settings, std::size_t try_index, double max_mps) {
  if (settings.speeds_mps.empty()) return max_mps;
  return std::min(max_mps, settings.speeds_mps[std::min(try_index, settings.speeds_mps.size() - 1)]);
}

}  // namespace

PassageDrive::PassageDrive(const ExploreConfig& config)
    : settings_(config.exploring.passage_drive),
      driving_(config.driving),
      speed_mps_(config.speed_mps),
      patience_s_(config.exploring.blocked.patience_s),
      map_(config.driving.local_map),
      follower_(follower(config.speed_mps)),
      back_up_(config.exploring.blocked.back_up) {}

RouteFollower PassageDrive::follower(double speed_mps) const {
  FollowSettings follow = driving_.follow;
  follow.slow_mps = speed_mps;
  return {
      {speed_mps, settings_.arrived_m}, follow, driving_.obstacles, ProgressChecker(patience_s_, driving_.progress)};
}

void PassageDrive::begin(const ExploreTask& task, const WorldView& world) {
  map_ = LocalMap(driving_.local_map);
  map_.see(world);
  try_ = 0;
  begun_s_ = world.time_s;
  is_backing_up_ = false;
  const auto fits = [&](double clearance_m) {
    return task.width_m + settings_.width_error_m >= 2.0 * (world.robot.radius_m + clearance_m);
  };
  while (try_ + 1 < settings_.clearances_m.size() && !fits(settings_.clearances_m[try_])) ++try_;
  begin_try(task, world);
}

void PassageDrive::begin_try(const ExploreTask& task, const WorldView& world) {
  const Point robot = world.pose.T_map_robot.position();
  std::vector<Point> path{robot};
  // Lined up before it, unless the robot is nearer already.
  if ((task.lookout - robot).dot(task.beyond_m - task.about) > 0.0) path.push_back(task.lookout);
  path.push_back(task.beyond_m);
  follower_ = follower(speed_of(settings_, try_, speed_mps_));
  map_.ignore_nothing();
  map_.ignore_along(path, world, {});
  const bool is_last = try_ + 1 >= settings_.clearances_m.size();
  follower_.take(path, is_last ? Leg::escape : Leg::route);
  follower_.restart_progress();
  is_backing_up_ = false;
}

bool PassageDrive::is_beyond(const ExploreTask& task, const WorldView& world) const {
  const Point from_middle = world.pose.T_map_robot.position() - task.about;
  const double in_m = from_middle.dot((task.beyond_m - task.about).normalized());
  return in_m > world.robot.radius_m + settings_.through_m &&
         from_middle.norm() < 2.0 * (task.beyond_m - task.about).norm();
}

Status PassageDrive::tick(const ExploreTask& task, const WorldView& world, MotionRequests& context) {
  map_.see(world);
  follower_.see(world, map_);
  if (is_beyond(task, world)) return {StepState::success, {}};
  if (is_backing_up_) return back_up(task, world, context);
  if (world.time_s - begun_s_ > settings_.at_most_s) return {StepState::failure, "it takes too long"};
  if (follower_.is_stuck(world)) return fail_try(task, world, context, "blocked");
  const ControlResult step = follower_.step(world, map_, context);
  if (step.state == ControlState::arrived) return {StepState::success, {}};
  return {StepState::running, "under way"};
}

Status PassageDrive::fail_try(const ExploreTask& task, const WorldView& world, MotionRequests& context,
                              const std::string& why) {
  const Point at = world.pose.T_map_robot.position();
  char text[96];
  std::snprintf(text, sizeof text, "%s at (%.2f, %.2f), with %.2f m beside the robot", why.c_str(), at.x(), at.y(),
                settings_.clearances_m.empty() ? 0.0 : settings_.clearances_m[try_]);
  why_ = text;
  back_up_.begin(world);
  is_backing_up_ = true;
  return back_up(task, world, context);
}

// Where it came from is free, but people walk.
Status PassageDrive::back_up(const ExploreTask& task, const WorldView& world, MotionRequests& context) {
  const auto is_blocked = [&](const std::vector<Point>& path, double along_m, double ahead_m) {
    return map_.is_blocked(world, path, along_m, ahead_m, world.robot.radius_m);
  };
  if (const std::optional<Twist> twist = back_up_.tick(world, is_blocked)) {
    follower_.drive_towards(*twist, world, context);
    return {StepState::running, "backing up"};
  }
  if (++try_ >= settings_.clearances_m.size()) return {StepState::failure, why_};
  begin_try(task, world);
  return {StepState::running, "trying it with less room"};
}

}  // namespace cairn::behaviours
