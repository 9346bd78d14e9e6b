// Follows a path of points with a differential (or car-like) robot: pure pursuit.
//
// Coulter: Implementation of the pure pursuit path tracking algorithm, CMU-RI-TR-92-01, 1992. Pure functions: where the
// robot is, the path and how far it has come along it go in; the wanted velocity and the new progress come out.
#pragma once

#include <span>

#include "framework/contracts/controller.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::pursuit_dwa {

struct FollowSettings {
  double lookahead_s = 1.2;
  double lookahead_min_m = 0.2;
  double lookahead_max_m = 0.5;
  double slow_down_ratio = 0.5;
  double crawl_mps = 0.03;
  double turn_in_place_rad = radians(50.0);
  double aligned_rad = radians(12.0);
  double search_back_m = 0.1;
  double search_ahead_m = 0.6;
  motion::TurnSettings turn;
  static void describe(Fields<FollowSettings>& fields);
};

struct FollowLimits {
  double speed_mps = 0.2;
  double max_w_radps = 1.0;
  double slow_down_mps2 = 0.2;  // deceleration planned for the end of the path
  double lookahead_m = 0.3;
  double arrive_m = 0.06;             // this near to the end counts as there
  double min_turning_radius_m = 0.0;  // > 0: a car, which never turns in place
  FollowSettings how{};
};

// The robot's own limits, at most the wanted speed.
[[nodiscard]] FollowLimits follow_limits(const RobotModel& robot, double speed_mps, const FollowSettings& how = {});

struct FollowStep {
  Twist wanted;
  PathProgress state;
  double left_m = 0.0;      // of the path
  double off_path_m = 0.0;  // distance to the nearest point of the path
  bool arrived = false;     // then wanted is a stop
};

// An empty path has arrived.
[[nodiscard]] FollowStep follow(const Pose2& T_map_robot, std::span<const Point> path, const PathProgress& state,
                                const FollowLimits& limits);

}  // namespace cairn::pursuit_dwa
