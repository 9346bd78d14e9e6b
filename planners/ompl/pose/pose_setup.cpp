#include "planners/ompl/pose/pose_setup.hpp"

#include "planners/common/pose_space/pose_recheck.hpp"
#include "planners/ompl/disc/disc_query.hpp"

namespace cairn {
namespace {

Footprint footprint_of(const OmplConfig& config, double radius_m, const RobotModel& robot) {
  const bool outlined = config.footprint == PlannerTraits::Shape::outline && !robot.polygon_m.empty();
  return outlined ? Footprint::polygon(robot.polygon_m) : Footprint::disc(radius_m);
}

KinematicRules kinematics_of(const OmplConfig& config, const RobotModel& robot) {
  KinematicRules rules;
  rules.kind = config.kinematics;
  rules.turning_radius_m = config.turning_radius_m > 0.0 ? config.turning_radius_m : robot.min_turning_radius_m;
  rules.driving = config.reverse ? Driving::either : Driving::forwards;
  rules.spot_turn_m = config.spot_turn_m;
  return rules;
}

// The ground from which the robot that stands there keeps less than it is planned to keep.
Covering covering_of(const Footprint& footprint, double margin_m, const Lattice& lattice) {
  const double reach_m = margin_m + kMinRadius_m;
  const auto covers = [=](const Pose2& T_map_robot, Cell cell) {
    const Point at = T_map_robot.position();
    if (footprint.is_disc())
      return distance_to_square_m(at, at, lattice.centre_of(cell), lattice.cell_m) <
             footprint.circumscribed_m() + reach_m;
    std::vector<Point> corners;
    for (const Point& corner : footprint.corners_m()) corners.push_back(T_map_robot * corner);
    return is_near(corners, reach_m, lattice, cell);
  };
  return {footprint.circumscribed_m() + reach_m, covers};
}

}  // namespace

PoseSetup::PoseSetup(const OmplConfig& config, double radius_m, const RobotModel& robot, const OccupancyGrid& grid)
    : footprint(footprint_of(config, radius_m, robot)),
      kinematics(kinematics_of(config, robot)),
      margin_m(config.margin_m + planning_margin_m(recheck_slack_m(grid.cell_m()))),
      ends(end_rules_of(config, footprint.inscribed_m())) {
  ends.start_tolerance_m = 0.0;
  ends.covering = covering_of(footprint, margin_m, {grid.origin_m(), grid.cell_m()});
}

}  // namespace cairn
