// Follows a path whatever the map says, by the mission's controller: only the collision monitor stops it.
#pragma once

#include <utility>
#include <vector>

#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/following/followed_path.hpp"
#include "plugins/behaviours/following/progress_checker.hpp"

namespace cairn::behaviours {

class DirectFollower {
 public:
  DirectFollower(double speed_mps, double tolerance_m, const ProgressChecker& progress)
      : speed_mps_(speed_mps), tolerance_m_(tolerance_m), progress_(progress) {}

  // A turn in place that is under way goes on.
  void take(std::vector<Point> points) { path_.take(std::move(points)); }
  // As take(), standing still.
  void begin(std::vector<Point> points) { path_.begin(std::move(points)); }
  [[nodiscard]] const std::vector<Point>& path() const { return path_.points(); }

  void restart_progress() { progress_.restart(); }
  // Once a tick of following: no progress for the patience.
  [[nodiscard]] bool is_stuck(const WorldView& world) { return progress_.is_stuck(world, wanted_); }
  // What the controller says; driven by drive().
  ControlResult ask(MotionRequests& context);
  void drive(const Twist& wanted, MotionRequests& context);
  // The robot does something else: nothing is wanted along the path.
  void stop() { wanted_ = {}; }

 private:
  double speed_mps_;
  double tolerance_m_;
  FollowedPath path_;
  ProgressChecker progress_;
  Twist wanted_;  // of the last tick
};

}  // namespace cairn::behaviours
