#include "framework/mission/loop/run_counts.hpp"

namespace cairn {

bool RunCounts::count(const Observation& observation) {
  if (has_begun_) figures_.distance_m += (observation.T_odom_robot.position() - T_odom_last_.position()).norm();
  has_begun_ = true;
  T_odom_last_ = observation.T_odom_robot;
  figures_.readings += static_cast<std::int64_t>(observation.ranges.size());
  const bool begins_to_touch = observation.bumped && !was_bumped_;
  was_bumped_ = observation.bumped;
  if (begins_to_touch) ++figures_.collisions;
  return begins_to_touch;
}

}  // namespace cairn
