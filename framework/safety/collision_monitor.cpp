#include "framework/safety/collision_monitor.hpp"

namespace cairn {

DriveCommand CollisionMonitor::drive(const Observation& observation, const Twist& wanted) {
  if (!drive_) return {};
  limiter_.see(observation);
  const Twist allowed = limiter_.limit(wanted);
  drive_.call([&](Drive& drive) { drive.command(allowed); });
  return {allowed, limiter_.speed_reduction_ratio(wanted, allowed)};
}

void CollisionMonitor::stop() {
  if (drive_) drive_.call([](Drive& drive) { drive.command(Twist{}); });
}

void CollisionMonitor::stop_after_giving_up(StageClock::Id lost, StageClock::Id sensor) noexcept {
  if (!drive_ || lost == sensor || lost == drive_.stage()) return;
  try {
    drive_.unwatched().command(Twist{});
  } catch (...) {
    // The module has failed already and is being left; there is no one to report to.
  }
}

}  // namespace cairn
