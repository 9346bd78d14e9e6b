// When a robot is where on a planned path.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

struct TrajectoryPoint {
  double time_s = 0.0;
  Pose2 pose;
  double v_mps = 0.0;  // negative: backwards
  double w_radps = 0.0;
};

// The fastest drive along a path, at rest at both ends, within the robot's speeds and accelerations. Between two
// points v and w are linear in time; times grow strictly.
//
// Where the headings of two poses fit an arc between them (densely sampled curves, straight segments) the robot drives
// along it, slow enough for the curvature and its changes. Elsewhere it drives straight and turns on the spot before
// and after; a car, which cannot, is taken to drive through everything. It drives backwards where a pose looks against
// the step to the next, and stops at cusps. Throws std::invalid_argument on limits that are not above 0 and on poses
// that are not finite. O(points).
[[nodiscard]] std::vector<TrajectoryPoint> trajectory_of(const std::vector<Pose2>& path, const RobotModel& robot);

}  // namespace cairn
