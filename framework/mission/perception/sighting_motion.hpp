// Brings sightings of markers from where their picture was taken to where the robot is now: a picture is older than the
// observation that it comes with, and the robot has moved on.
#pragma once

#include <vector>

#include "framework/contracts/observation.hpp"

namespace cairn {

class SightingMotion {
 public:
  // In order of time.
  void add(double stamp_s, const Pose2& T_odom_robot);
  // By the odometry between then and the last pose added. One that is not older than that, or whose past is not known,
  // stays as it is.
  void bring_to_now(MarkerSighting& sighting) const;

 private:
  struct Known {
    double stamp_s = 0.0;
    Pose2 T_odom_robot;
  };
  [[nodiscard]] Pose2 at(double stamp_s) const;

  std::vector<Known> known_;
};

}  // namespace cairn
