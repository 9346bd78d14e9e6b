#include "plugins/behaviours/following/route_follower.hpp"

#include <algorithm>

#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

std::vector<Point> points_of(const std::vector<Pose2>& path) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const Pose2& pose : path) points.push_back(pose.position());
  return points;
}

}  // namespace

void FollowSettings::describe(Fields<FollowSettings>& fields) {
  using C = FollowSettings;
  fields.number("blocked_ahead_m", &C::blocked_ahead_m, {0.0, 50.0}, "m",
                "something that turns up on the path within this makes the robot plan again");
  fields.number("escape_tolerance_m", &C::escape_tolerance_m, {0.001, 1.0}, "m",
                "this near to the end of a path out of a tight place is there");
  fields.number("slow_within_m", &C::slow_within_m, {0.0, 10.0}, "m",
                "within this of something on the map that the path ignores the robot drives slowly");
  fields.number("slow_mps", &C::slow_mps, {0.001, 5.0}, "m/s", "so slowly: touching it would do no harm");
}

void RouteFollower::see(const WorldView& world, const LocalMap& map) {
  motion_.tick(world.time_s);
  obstacles_.see(world, map.echoes(), map.ignored());
}

void RouteFollower::take(const std::vector<Point>& path, Leg leg) {
  path_.take(path);
  segments_.clear();
  leg_ = leg;
  optimism_.reset();
}

void RouteFollower::take_local(const std::vector<Point>& path, Optimism optimism) {
  take(path, Leg::route);
  optimism_ = optimism;
}

void RouteFollower::take_route(const PlanResult& result, const Place& goal, double cell_m) {
  std::vector<Point> points = points_of(result.path);
  // Planners over cells end in the middle of one.
  if (goal.pose && !points.empty() && (points.back() - goal.pose->position()).norm() < cell_m)
    points.back() = goal.pose->position();
  take(points, Leg::route);
  segments_ = result.segments;
}

std::vector<Point> RouteFollower::path_ahead() const {
  const std::vector<Point>& path = path_.points();
  if (path.empty()) return {};
  std::vector<Point> ahead{motion::point_along(path, path_.along_m())};
  double end_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    end_m += (path[i] - path[i - 1]).norm();
    if (end_m > path_.along_m()) ahead.push_back(path[i]);
  }
  return ahead;
}

void RouteFollower::move_route(std::vector<Point> ahead) {
  double behind_m = path_.along_m();
  while (!segments_.empty() && segments_.front().length_m <= behind_m) {
    behind_m -= segments_.front().length_m;
    segments_.erase(segments_.begin());
  }
  if (!segments_.empty()) segments_.front().length_m -= behind_m;
  path_.take(std::move(ahead));
}

void RouteFollower::restart_progress() {
  unhindered_ = {};
  progress_.restart();
}

bool RouteFollower::is_stuck(const WorldView& world) {
  return progress_.is_stuck(world, unhindered_);
}

// One cell less than the planner's disc, so that the two never disagree about the same map.
bool RouteFollower::is_path_blocked(const WorldView& world, const LocalMap& map, double ahead_m) const {
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  return leg_ != Leg::escape && map.is_blocked(world, path_.points(), path_.along_m(), ahead_m, margin_m);
}

ControlResult RouteFollower::step(const WorldView& world, const LocalMap& map, MotionRequests& context) {
  ControlRequest request = path_.request();
  request.speed_mps = wish_.speed_mps;
  if (map.ignores_near(world.pose.T_map_robot.position(), settings_.slow_within_m + world.robot.radius_m))
    request.speed_limit_mps = settings_.slow_mps;
  request.tolerance_m = leg_ == Leg::escape ? settings_.escape_tolerance_m : wish_.tolerance_m;
  request.avoids_obstacles = leg_ != Leg::escape;
  request.obstacles = obstacles_.points();
  request.velocity = motion_.velocity(world);
  request.period_s = motion_.period_s();
  speed_mps_ = std::min(request.speed_mps, request.speed_limit_mps);
  const ControlResult result = context.control(request);
  path_.record(result);
  if (result.state == ControlState::arrived) return result;
  unhindered_ = result.unhindered;
  if (leg_ == Leg::escape)
    motion_.drive_towards(result.twist, world, context);
  else
    motion_.drive(result.twist, context);
  return result;
}

double RouteFollower::left_s(const ControlResult& step, const WorldView& world) const {
  return step.left_m / std::min(speed_mps_, world.robot.max_v_mps);
}

void RouteFollower::drive_towards(const Twist& target, const WorldView& world, MotionRequests& context) {
  motion_.drive_towards(target, world, context);
}

RouteId RouteFollower::route_ahead() const {
  double end_m = 0.0;
  for (const PathSegment& segment : segments_) {
    end_m += segment.length_m;
    if (end_m >= path_.along_m() && segment.route != 0) return segment.route;
  }
  return 0;
}

}  // namespace cairn::behaviours
