// Notices that the robot does not get on: the stop layer cuts its speed, it bumps, or it just stands.
#pragma once

#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

class ProgressChecker {
 public:
  explicit ProgressChecker(double patience_s = 2.5) : patience_s_(patience_s) {}

  void restart() { *this = ProgressChecker(patience_s_); }
  // Told every tick what was wanted in the tick before, forwards or a turn in place; true when the robot has not got
  // on for the patience, or at once when it has bumped into something while it wanted to go ahead.
  [[nodiscard]] bool is_stuck(const WorldView& world, const Twist& wanted);

 private:
  double patience_s_;
  double last_s_ = -1.0;
  Pose2 T_map_last_;
  double stuck_s_ = 0.0;
};

}  // namespace cairn::behaviours
