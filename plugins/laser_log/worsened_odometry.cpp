#include "plugins/laser_log/worsened_odometry.hpp"

#include <cmath>
#include <numbers>

namespace cairn::laser_log {

void WornWheels::describe(Fields<WornWheels>& fields) {
  fields.number("length_ratio", &WornWheels::length_ratio, {-0.5, 1.0}, "",
                "what the wheels count too much of each step's length, all the way");
  fields.angle("deg_per_m", &WornWheels::rad_per_m, {0.0, 180.0},
               "standard deviation of the turn that each metre adds; of a step it grows with the root of its length");
  fields.integer("seed", &WornWheels::seed, {0, 1e9}, "of these turns");
}

Pose2 WorsenedOdometry::next(const Pose2& T_odom_robot) {
  if (!is_finite(T_odom_robot) || (wheels_.length_ratio == 0.0 && wheels_.rad_per_m == 0.0)) return T_odom_robot;
  if (!T_odom_robot_) {
    T_worn_robot_ = T_odom_robot;
  } else {
    const Pose2 step = inverse(*T_odom_robot_) * T_odom_robot;
    const double turned_rad = wheels_.rad_per_m * std::sqrt(step.position().norm()) * normal();
    const double counted = 1.0 + wheels_.length_ratio;
    T_worn_robot_ =
        T_worn_robot_ * Pose2{counted * step.x_m, counted * step.y_m, wrap_angle(step.theta_rad + turned_rad)};
  }
  T_odom_robot_ = T_odom_robot;
  return T_worn_robot_;
}

// Box and Muller.
double WorsenedOdometry::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random_.share()));
  return radius * std::cos(2.0 * std::numbers::pi * random_.share());
}

}  // namespace cairn::laser_log
