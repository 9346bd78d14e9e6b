// What the stop layer's tests show it.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "framework/safety/velocity_limiter.hpp"

namespace cairn {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kTick_s = 0.04;

inline RangeReading reading(double range_m, double angle_rad = 0.0, int sensor = 0) {
  RangeReading reading;
  reading.T_robot_sensor = {0.1 * std::cos(angle_rad), 0.1 * std::sin(angle_rad), angle_rad};
  reading.half_beam_rad = radians(15.0);
  reading.min_m = 0.1;
  reading.max_m = 5.0;
  reading.range_m = range_m;
  reading.sensor = sensor;
  return reading;
}

// A robot whose transducers look ahead (0), back (1) and to the left (2), and fire all at once.
inline RobotModel a_robot() {
  RobotModel robot;
  robot.firing_period_s = 0.0;
  return robot;
}

struct Seen {
  double ahead_m = kInfinity;
  double behind_m = kInfinity;
  double left_m = kInfinity;
};

inline Observation observation(double stamp_s, const Seen& seen = {}, const Pose2& T_odom_robot = {}) {
  Observation o;
  o.stamp_s = stamp_s;
  o.T_odom_robot = T_odom_robot;
  o.ranges = {reading(seen.ahead_m), reading(seen.behind_m, std::numbers::pi, 1),
              reading(seen.left_m, 0.5 * std::numbers::pi, 2)};
  return o;
}

// Standing, with these ranges for two ticks.
inline VelocityLimiter layer_that_sees(const Seen& seen, const RobotModel& robot = a_robot(),
                                       const CollisionMonitorConfig& config = {}) {
  VelocityLimiter layer(config, robot);
  layer.see(observation(1.0, seen));
  layer.see(observation(1.0 + kTick_s, seen));
  return layer;
}

inline Observation without_readings(double stamp_s) {
  Observation silent;
  silent.stamp_s = stamp_s;
  return silent;
}

}  // namespace cairn
