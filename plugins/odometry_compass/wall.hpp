// A straight stretch of wall as the robot has met it.
#pragma once

#include <Eigen/Core>

namespace cairn::odometry_compass {

struct SeenWall {
  double bearing_rad = 0.0;  // of its normal, from the robot to the wall, in robot coordinates
  double distance_m = 0.0;   // of the robot from its line, along the normal; negative: beyond it
  // Of bearing_rad and distance_m.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  // The stretch that answered, along the wall, from the robot's foot on it; rising to the left of the normal.
  double begin_m = 0.0;
  double end_m = 0.0;
  bool is_conservatively_straight = false;  // seen from places so far apart that a round thing would have shown
};

// A known wall as the robot should meet it from where it believes to be.
struct ExpectedWall {
  int wall = 0;
  double bearing_rad = 0.0;
  double distance_m = 0.0;
  double deviation_m = 0.0;  // of the distance
  double begin_m = 0.0;      // as SeenWall's
  double end_m = 0.0;
};

}  // namespace cairn::odometry_compass
