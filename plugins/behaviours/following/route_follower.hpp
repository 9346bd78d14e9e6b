// Follows the path of a drive by the mission's controller, and watches the progress.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/following/commanded_motion.hpp"
#include "plugins/behaviours/following/followed_path.hpp"
#include "plugins/behaviours/following/progress_checker.hpp"
#include "plugins/behaviours/local_map/local_map.hpp"
#include "plugins/behaviours/local_map/local_obstacles.hpp"

namespace cairn::behaviours {

// What a path is for.
enum class Leg { route, escape, to_look, aside };

struct FollowSettings {
  double blocked_ahead_m = 1.0;
  double escape_tolerance_m = 0.02;
  double slow_within_m = 0.25;
  double slow_mps = 0.05;
  static void describe(Fields<FollowSettings>& fields);
};

// Speed and nearness of one drive.
struct FollowWish {
  double speed_mps = 0.25;
  double tolerance_m = 0.1;
};

class RouteFollower {
 public:
  RouteFollower(const FollowWish& wish, const FollowSettings& settings, const LocalObstacleSettings& obstacles,
                const ProgressChecker& progress)
      : wish_(wish), settings_(settings), obstacles_(obstacles), progress_(progress) {}

  // Every tick.
  void see(const WorldView& world, const LocalMap& map);

  void take(const std::vector<Point>& path, Leg leg);
  // On the local map.
  void take_local(const std::vector<Point>& path, Optimism optimism);
  // By the planner; the last point becomes the goal's own where it is in the same cell.
  void take_route(const PlanResult& result, const Place& goal, double cell_m);

  // What of the path is still before the robot.
  [[nodiscard]] std::vector<Point> path_ahead() const;
  // The map has been exchanged, and what was ahead on a planner's route lies there now.
  void move_route(std::vector<Point> ahead);
  void forget_obstacles() { obstacles_.forget(); }

  // The robot does something else from now on: progress is measured anew.
  void restart_progress();
  // Once a tick of following: no progress for the patience.
  [[nodiscard]] bool is_stuck(const WorldView& world);
  // Whether something has turned up on the path ahead.
  [[nodiscard]] bool is_path_blocked(const WorldView& world, const LocalMap& map) const {
    return is_path_blocked(world, map, settings_.blocked_ahead_m);
  }
  [[nodiscard]] bool is_path_blocked(const WorldView& world, const LocalMap& map, double ahead_m) const;
  // Drives on. Slowly where the map has something that the path ignores.
  ControlResult step(const WorldView& world, const LocalMap& map, MotionRequests& context);
  // Until the end of the path, as after this step.
  [[nodiscard]] double left_s(const ControlResult& step, const WorldView& world) const;
  // Not along the path.
  void drive_towards(const Twist& target, const WorldView& world, MotionRequests& context);

  [[nodiscard]] Leg leg() const { return leg_; }
  [[nodiscard]] const std::vector<Point>& path() const { return path_.points(); }
  // Of a path on the local map; none: it is the planner's.
  [[nodiscard]] const std::optional<Optimism>& optimism() const { return optimism_; }
  [[nodiscard]] const LocalObstacles& obstacles() const { return obstacles_; }
  // The stored route that the robot is on or comes to next; 0: none.
  [[nodiscard]] RouteId route_ahead() const;

 private:
  FollowWish wish_;
  FollowSettings settings_;
  FollowedPath path_;
  Leg leg_ = Leg::route;
  std::optional<Optimism> optimism_;
  std::vector<PathSegment> segments_;  // of the path, when it is the planner's
  LocalObstacles obstacles_;
  CommandedMotion motion_;
  ProgressChecker progress_;
  Twist unhindered_;        // of the last tick
  double speed_mps_ = 0.0;  // top speed in the last tick
};

}  // namespace cairn::behaviours
