// How far a footprint can be driven along an arc before it comes too near to a point.
#pragma once

#include "framework/contracts/robot_model.hpp"

namespace cairn {

// From the footprint's edge to a point of the robot's frame; negative inside. A disc without a polygon.
[[nodiscard]] double distance_to_footprint_m(const RobotModel& robot, const Point& p);

// Of the farthest corner (or the disc's edge) from the robot's origin.
[[nodiscard]] double reach_of_m(const RobotModel& robot);

// Speed of the point of the footprint that moves fastest; a disc that turns sweeps nothing new.
[[nodiscard]] double sweep_speed_mps(const RobotModel& robot, const Twist& twist);

// Metres that the fastest point of the footprint can go on the twist's arc before the footprint is nearer to the point
// than margin_m; +inf when it never is within at_most_m. A point that is nearer already is 0 when the arc leads nearer
// still by more than a fifth of its first metres, and no hindrance otherwise. Steps of step_m.
[[nodiscard]] double free_sweep_m(const RobotModel& robot, const Twist& twist, const Point& p, double margin_m,
                                  double at_most_m, double step_m = 0.01);

}  // namespace cairn
