// How fast the robot goes by a behaviour's own commands, from tick to tick.
#pragma once

#include "framework/contracts/behaviour.hpp"

namespace cairn::behaviours {

class CommandedMotion {
 public:
  // Every tick, before anything is commanded.
  void tick(double time_s);
  // Drives at the target as soon as the robot's accelerations allow: turns in place, backing up.
  void drive_towards(const Twist& target, const WorldView& world, MotionRequests& context);
  // Drives as the controller says, which has kept to the accelerations.
  void drive(const Twist& twist, MotionRequests& context);

  // As last commanded, less what the collision monitor has cut.
  [[nodiscard]] Twist velocity(const WorldView& world) const;
  [[nodiscard]] double period_s() const { return period_s_; }

 private:
  Twist commanded_;
  double last_s_ = -1e9;
  double period_s_ = 0.0;
};

}  // namespace cairn::behaviours
