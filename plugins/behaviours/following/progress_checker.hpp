// Notices that the robot makes no progress: the collision monitor cuts its speed, it bumps, or it just stands.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

struct ProgressSettings {
  double speed_reduction_ratio = 0.7;
  double standing_ratio = 0.1;
  double bump_s = 0.2;
  double recovery_ratio = 2.0;
  static void describe(Fields<ProgressSettings>& fields);
};

class ProgressChecker {
 public:
  explicit ProgressChecker(double patience_s = 2.5, const ProgressSettings& settings = {})
      : patience_s_(patience_s), settings_(settings) {}

  void restart() { *this = ProgressChecker(patience_s_, settings_); }
  // Every tick, with the velocity wanted in the tick before, forwards or a turn in place. True when the robot has made
  // no progress for the patience, or at once when it has bumped into something while it wanted to go ahead.
  [[nodiscard]] bool is_stuck(const WorldView& world, const Twist& wanted);

 private:
  double patience_s_;
  ProgressSettings settings_;
  double last_s_ = -1.0;
  Pose2 T_map_last_;
  double stuck_s_ = 0.0;
};

}  // namespace cairn::behaviours
