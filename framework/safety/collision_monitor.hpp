// The collision monitor: below every behaviour, the only one that orders the drive, and it never lets the robot drive
// into what its sensors see (VelocityLimiter). Nothing in a mission takes it away.
//
// A command holds until the next one: the robot stands while the host does something that may take long, and is ordered
// on at the end of the tick.
#pragma once

#include "framework/contracts/sensor.hpp"
#include "framework/modules/staged.hpp"
#include "framework/safety/velocity_limiter.hpp"

namespace cairn {

// What has become of the wanted velocity of a tick.
struct DriveCommand {
  Twist commanded{};
  double speed_reduction_ratio = 0.0;  // share of the wanted speed that was left out: 0 none, 1 all
};

class CollisionMonitor {
 public:
  CollisionMonitor(const CollisionMonitorConfig& config, const RobotModel& robot) : limiter_(config, robot) {}

  // Before the run. Without a drive (a log) nothing is ordered.
  void attach(Staged<Drive> drive) { drive_ = std::move(drive); }
  [[nodiscard]] bool has_drive() const { return static_cast<bool>(drive_); }

  // Once a tick: limits the wanted velocity by what this observation and those before have shown, and orders it.
  // Throws ModuleFault.
  DriveCommand drive(const Observation& observation, const Twist& wanted);
  // The robot stands until the next drive(). Throws ModuleFault.
  void stop();
  // For the thread that has given the mission up: stops the robot unless the call that was lost is one of the drive's
  // own module.
  void stop_after_giving_up(StageClock::Id lost, StageClock::Id sensor) noexcept;

  [[nodiscard]] const CollisionMonitorFigures& figures() const { return limiter_.figures(); }

 private:
  VelocityLimiter limiter_;
  Staged<Drive> drive_;
};

}  // namespace cairn
