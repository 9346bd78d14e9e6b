// What requests for a robot whose heading matters are planned with.
#pragma once

#include "planners/common/disc_space/ends.hpp"
#include "planners/ompl/ompl_planner.hpp"
#include "planners/ompl/pose/kinematic_spaces.hpp"

namespace cairn {

// The same for all requests with one radius on grids of one cell size.
struct PoseSetup {
  // radius_m: of the request, for robots without an outline.
  PoseSetup(const OmplConfig& config, double radius_m, const RobotModel& robot, const OccupancyGrid& grid);

  // Of the discs whose routes are looked for: one that gets wherever the robot does, and one in which it can turn.
  [[nodiscard]] double inner_radius_m() const { return ends.radius_m + kMinRadius_m; }
  [[nodiscard]] double outer_radius_m() const { return footprint.circumscribed_m() + margin_m; }

  Footprint footprint;
  KinematicRules kinematics;
  double margin_m;  // that what is planned keeps from everything
  EndRules ends;    // for a disc that the outline holds
};

}  // namespace cairn
