// Follows the path of an exploring task by the mission's controller, and watches the progress.
#pragma once

#include <vector>

#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/following/commanded_motion.hpp"
#include "plugins/behaviours/following/followed_path.hpp"
#include "plugins/behaviours/following/progress_checker.hpp"
#include "plugins/behaviours/local_map/local_obstacles.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"

namespace cairn::behaviours {

class TaskFollower {
 public:
  explicit TaskFollower(const ExploreConfig& config)
      : speed_mps_(config.speed_mps),
        arrived_m_(config.exploring.motion.arrived_m),
        progress_(config.exploring.blocked.patience_s, config.driving.progress),
        obstacles_(config.driving.obstacles) {}

  // Every tick.
  void see(const WorldView& world, const NearEchoes& near_echoes);
  void take(const std::vector<Point>& path) { path_.take(path); }
  // The map has been exchanged.
  void forget_obstacles() { obstacles_.forget(); }
  [[nodiscard]] double along_m() const { return path_.along_m(); }

  // The robot does something else from now on: progress is measured anew.
  void restart_progress();
  // Once a tick of following: no progress for the patience.
  [[nodiscard]] bool is_stuck(const WorldView& world) { return progress_.is_stuck(world, wanted_); }
  // Drives on along the path.
  ControlResult step(double speed_limit_mps, const WorldView& world, BehaviourContext& context);
  // Not along the path.
  void drive(const Twist& wanted, const WorldView& world, BehaviourContext& context);

 private:
  double speed_mps_;
  double arrived_m_;
  FollowedPath path_;
  ProgressChecker progress_;
  LocalObstacles obstacles_;
  CommandedMotion motion_;
  Twist wanted_;  // of the last tick
};

}  // namespace cairn::behaviours
