// How far the robot has driven and turned.
#pragma once

#include <cmath>

#include "maps/geometry/pose.hpp"

namespace cairn::behaviours {

struct Travelled {
  Pose2 T_map_last;
  double driven_m = 0.0;
  double turned_rad = 0.0;

  void add(const Pose2& T_map_robot) {
    turned_rad += std::abs(wrap_angle(T_map_robot.theta_rad - T_map_last.theta_rad));
    driven_m += (T_map_robot.position() - T_map_last.position()).norm();
    T_map_last = T_map_robot;
  }
};

}  // namespace cairn::behaviours
