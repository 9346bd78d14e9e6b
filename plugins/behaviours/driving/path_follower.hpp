// Follows a path of points with a differential (or car-like) robot: pure pursuit.
//
// Pure functions: where the robot is, the path and how far it has come along it go in; the wanted
// velocity and the new progress come out.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "maps/geometry/pose.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn::behaviours {

struct FollowLimits {
  double speed_mps = 0.2;
  double max_w_radps = 1.0;
  double slow_down_mps2 = 0.2;  // deceleration planned for the end of the path
  double lookahead_m = 0.3;
  double arrive_m = 0.06;                    // this near to the end counts as there
  double turn_in_place_rad = radians(50.0);  // a larger heading error stops the robot for turning
  double min_turning_radius_m = 0.0;         // > 0: a car, which never turns in place
};

// The robot's own limits, at most the wanted speed.
[[nodiscard]] FollowLimits follow_limits(const RobotModel& robot, double speed_mps);

struct FollowState {
  double along_m = 0.0;  // how much of the path is behind the robot
  bool turning = false;  // in place
};

struct FollowStep {
  Twist wanted;
  FollowState state;
  double left_m = 0.0;      // of the path
  double off_path_m = 0.0;  // distance to the nearest point of the path
  bool arrived = false;     // then wanted is a stop
};

// An empty path has arrived.
[[nodiscard]] FollowStep follow(const Pose2& T_map_robot, const std::vector<Point>& path, const FollowState& state,
                                const FollowLimits& limits);

// Turning in place by heading_error_rad (anticlockwise positive); no turn within 2 degrees.
[[nodiscard]] Twist turn_by(double heading_error_rad, double max_w_radps);
[[nodiscard]] double heading_error(const Pose2& T_map_robot, const Point& target_map);

// The point this far along the path; its ends beyond them. The path must not be empty.
[[nodiscard]] Point point_along(const std::vector<Point>& path, double along_m);

}  // namespace cairn::behaviours
