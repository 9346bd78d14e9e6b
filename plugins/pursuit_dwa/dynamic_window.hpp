// Avoidance of obstacles below a path: the dynamic window approach.
//
// Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation Magazine 4(1),
// 1997. Candidate velocities are those that the robot can reach within its accelerations; one is admissible when the
// robot can stop on its arc before the first obstacle (eq. 14); the best one weighs heading, clearance and speed
// (eq. 13). The velocity that the path follower prefers is taken as it is where its own arc is free, so that in the
// open the robot follows its path exactly. Pure functions.
#pragma once

#include <span>

#include "framework/config/fields.hpp"
#include "framework/contracts/view/speed_law.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::pursuit_dwa {

struct WindowSettings {
  double clearance_m = SpeedLaw{}.tight_m;
  double tight_clearance_m = 0.03;
  double tight_speed_mps = SpeedLaw{}.tight_mps;
  double window_s = 0.4;
  int speeds = 5;
  int turn_rates = 15;
  double judged_after_s = 1.0;
  double reaction_s = 0.3;
  double braking_ratio = 0.8;
  double spare_m = 0.08;
  double far_m = 1.0;
  double min_speed_mps = 0.05;
  double heading_weight = 1.0;
  double clearance_weight = 0.5;
  double speed_weight = 0.25;
  double preference_weight = 0.15;
  double contact_step_m = 0.05;
  double contact_ratio = 0.3;
  static void describe(Fields<WindowSettings>& fields);
};

struct WindowLimits {
  double max_v_mps = 0.25;
  double max_w_radps = 0.9;
  motion::Accelerations accelerations{};
  double radius_m = 0.22;  // of the disc that the footprint fits in
};
[[nodiscard]] WindowLimits window_limits(const RobotModel& robot, double speed_mps, double max_turn_radps);

// Metres of the arc of a twist (backwards for v < 0) that a disc about the robot's origin can go before its centre is
// within reach_m of an obstacle (robot frame); +inf when it never is. An obstacle that is within reach already only
// counts while the disc comes nearer to it. v must not be 0.
[[nodiscard]] double free_distance_m(const Twist& twist, std::span<const Point> obstacles, double reach_m,
                                     const WindowSettings& settings = {});

struct Wish {
  Twist preferred;      // by the path follower
  Point aim{0.0, 0.0};  // on the path, robot frame
};

struct WindowStep {
  Twist target;          // the window's best candidate
  bool blocked = false;  // nothing admissible leads on: target is a stop
};

// The velocity to go for. Obstacles in the robot frame.
[[nodiscard]] WindowStep best_in_window(const Twist& now, const Wish& wish, std::span<const Point> obstacles,
                                        const WindowLimits& limits, const WindowSettings& settings = {});

}  // namespace cairn::pursuit_dwa
