#include "framework/live/continuity.hpp"

#include <algorithm>
#include <utility>

namespace cairn::live {
namespace {

// A stamp this much further ahead than time has passed here is of a clock that was set.
constexpr double kMaxAhead_s = 2.0;
constexpr double kMaxLeap_m = 0.5;  // besides twice what the top speed allows

}  // namespace

Observation assembled(std::vector<Observation> observations) {
  Observation now = std::move(observations.back());
  observations.pop_back();
  std::vector<RangeReading> ranges;
  std::vector<CameraImage> images;
  for (const Observation& then : observations) {
    now.bumped = now.bumped || then.bumped;
    if (now.stamp_s - then.stamp_s > kMaxReadingAge_s) continue;
    const Pose2 T_now_then = inverse(now.T_odom_robot) * then.T_odom_robot;
    for (RangeReading reading : then.ranges) {
      reading.T_robot_sensor = T_now_then * reading.T_robot_sensor;
      ranges.push_back(reading);
    }
    images.insert(images.end(), then.images.begin(), then.images.end());
  }
  now.images.insert(now.images.begin(), images.begin(), images.end());
  now.ranges.insert(now.ranges.begin(), ranges.begin(), ranges.end());
  return now;
}

Observation Continuity::continued(Observation observation, double arrived_s) {
  const double stamp_s = observation.stamp_s;
  const Pose2 T_base_robot = observation.T_odom_robot;
  if (!last_) {
    T_odom_base_ = inverse(T_base_robot);
  } else {
    const double elapsed_s = arrived_s - last_->arrived_s;
    const double passed_s = stamp_s - last_->stamp_s;
    const bool is_clock_set = passed_s < 0.0 || passed_s > elapsed_s + behind_s_ + kMaxAhead_s;
    const double moved_m = (T_base_robot.position() - last_->T_base_robot.position()).norm();
    const bool has_leapt = moved_m > kMaxLeap_m + 2.0 * max_v_mps_ * elapsed_s;
    behind_s_ = is_clock_set ? 0.0 : std::max(0.0, behind_s_ + elapsed_s - passed_s);
    if (is_clock_set) restart_clock(stamp_s, arrived_s);
    if (is_interrupted_ && (is_clock_set || has_leapt))
      T_odom_base_ = last_->given.T_odom_robot * inverse(T_base_robot);
  }
  is_interrupted_ = false;
  observation.stamp_s = stamp_s + offset_s_;
  observation.T_odom_robot = T_odom_base_ * T_base_robot;
  last_ = Last{arrived_s, stamp_s, T_base_robot, observation};
  return observation;
}

// The stamps given go on by the time that has passed here.
void Continuity::restart_clock(double stamp_s, double arrived_s) {
  if (!is_interrupted_) ++clock_steps_;
  offset_s_ = last_->given.stamp_s + (arrived_s - last_->arrived_s) - stamp_s;
}

}  // namespace cairn::live
