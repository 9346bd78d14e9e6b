#include "planners/ompl/ompl_planner.hpp"

#include <stdexcept>

#include "planners/common/pose_space/footprint.hpp"
#include "planners/ompl/disc/disc_query.hpp"
#include "planners/ompl/pose/pose_query.hpp"
#include "planners/ompl/pose/pose_setup.hpp"

namespace cairn {

namespace {

void describe_cost(Fields<OmplConfig>& fields) {
  fields.choice(
      "objective", &OmplConfig::objective,
      {{"as_driven", Objective::as_driven},
       {"as_asked", Objective::as_asked},
       {"length", Objective::length},
       {"time", Objective::time},
       {"clearance", Objective::clearance},
       {"weighted", Objective::weighted}},
      "what routes are counted by; time: seconds at the speed that is allowed beside obstacles; as_asked: the "
      "request's cost; as_driven: the same, but time instead of length where the robot is known: in missions, "
      "on maps that one saved, and with a robot file");
  fields.number("length_weight", &OmplConfig::length_weight, {0.0, 1e6}, "1/m", "of `weighted`, a metre");
  fields.number("time_weight", &OmplConfig::time_weight, {0.0, 1e6}, "1/s", "of `weighted`, a second");
  fields.number("clearance_weight", &OmplConfig::clearance_weight, {0.0, 1e6}, "1/m",
                "of `weighted`, what a metre counts on top where there is little room");
  fields.choice(
      "unknown", &OmplConfig::unknown,
      {{"avoid", UnknownGround::avoid}, {"allow", UnknownGround::allow}, {"cost", UnknownGround::cost}},
      "whether routes may cross cells that have not been seen; cost: they may, and a metre counts unknown_weight");
  fields.number("unknown_weight", &OmplConfig::unknown_weight, {1.0, 1e6}, "",
                "what a metre over cells that have not been seen counts, with `unknown: cost`");
}

void describe_motion(Fields<OmplConfig>& fields) {
  fields.choice(
      "kinematics", &OmplConfig::kinematics,
      {{"disc", MotionKind::holonomic},
       {"differential", MotionKind::differential},
       {"dubins", MotionKind::dubins},
       {"reeds_shepp", MotionKind::reeds_shepp}},
      "how the robot moves: a disc in any direction; differential turns on the spot and drives straight; dubins drives "
      "forwards on circles and straight lines, reeds_shepp backwards too");
  fields.choice("footprint", &OmplConfig::footprint,
                {{"disc", PlannerTraits::Shape::disc}, {"robot", PlannerTraits::Shape::outline}},
                "what must fit: a disc of the request's radius, or the robot's own outline (not for kinematics disc)");
  fields.number("turning_radius_m", &OmplConfig::turning_radius_m, {0.0, 1e3}, "m",
                "dubins and reeds_shepp: the tightest circle; 0: that of the robot's file");
  fields.flag("reverse", &OmplConfig::reverse, "differential: may also drive backwards");
  fields.number("spot_turn_m", &OmplConfig::spot_turn_m, {1e-3, 10.0}, "m",
                "differential: metres that a radian turned on the spot counts");
}

}  // namespace

void OmplConfig::describe(Fields<OmplConfig>& fields) {
  fields.choice(
      "algorithm", &OmplConfig::algorithm, algorithm_names(),
      "AnyAngleRRTstar: the shortest route over the grid, at any angle, or the fastest over its cells, improved by "
      "OMPL's InformedRRTstar; or a planner of OMPL alone, by OMPL's name");
  fields.integer("iterations", &OmplConfig::iterations, {1, 1e9},
                 "how often a search from nothing may ask whether to go on; a count, so that answers do not depend on "
                 "the machine's speed");
  fields.integer("improve_iterations", &OmplConfig::improve_iterations, {0, 1e9},
                 "AnyAngleRRTstar: iterations to improve a route that is longer than good_enough_ratio times what any "
                 "must be; 0: until the budget's deadline, none without one");
  fields.number("good_enough_ratio", &OmplConfig::good_enough_ratio, {1.0, 100.0}, "",
                "AnyAngleRRTstar: a route at most so much longer, or slower, than any must be is not improved");
  describe_cost(fields);
  describe_motion(fields);
  fields.number("margin_m", &OmplConfig::margin_m, {0.0, 2.0}, "m", "added to the robot's radius");
  fields.number("start_tolerance_m", &OmplConfig::start_tolerance_m, {0.0, 1.0}, "m",
                "how far a start that is too near to something may be left with what clearance it has");
  fields.flag("simplify", &OmplConfig::simplify, "shorten what a planner of OMPL found");
  fields.flag("fall_back_to_grid", &OmplConfig::fall_back_to_grid,
              "when a planner of OMPL finds nothing, take the shortest route over the grid");
  fields.raw("parameters", &OmplConfig::parameters, "map", "OMPL's own parameters of the algorithm, by name");
}

namespace {

const SourcePlace kPlace{"ompl", 0, 0};

// Sentences without a place: a setting's own is not known here.
void check_outline(const RobotModel& robot) {
  try {
    (void)Footprint::polygon(robot.polygon_m);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(kPlace, std::string("the robot's outline is none: ") + error.what());
  }
}

void check_motion(const OmplConfig& config, const RobotModel& robot) {
  const bool is_car = config.kinematics == MotionKind::dubins || config.kinematics == MotionKind::reeds_shepp;
  if (is_car && config.turning_radius_m <= 0.0 && robot.min_turning_radius_m <= 0.0)
    throw ConfigError(kPlace, "a robot that does not turn on the spot needs turning_radius_m, here or in its file");
  if (is_car && config.turning_radius_m > 0.0 && config.turning_radius_m < robot.min_turning_radius_m)
    throw ConfigError(kPlace, "turning_radius_m " + config_detail::number_text(config.turning_radius_m) +
                                  " is tighter than the robot's own min_turning_radius_m " +
                                  config_detail::number_text(robot.min_turning_radius_m));
  if (config.kinematics == MotionKind::holonomic && config.footprint == PlannerTraits::Shape::outline &&
      !robot.polygon_m.empty())
    throw ConfigError(kPlace, "the robot's outline is not a disc; give kinematics differential, dubins or reeds_shepp");
  if (config.footprint == PlannerTraits::Shape::outline && !robot.polygon_m.empty()) check_outline(robot);
  if (works_with(config.kinematics, config.algorithm)) return;
  std::string working;
  std::string chosen;
  for (const auto& [name, algorithm] : algorithm_names())
    if (algorithm == config.algorithm)
      chosen = name;
    else if (works_with(config.kinematics, algorithm))
      working += (working.empty() ? "" : ", ") + name;
  throw ConfigError(kPlace, chosen + " does not do for such kinematics; these do: " + working);
}

}  // namespace

OmplPlanner::OmplPlanner(OmplConfig config, const RobotModel& robot)
    : config_(std::move(config)), parameters_(checked_parameters(config_.algorithm, config_.parameters)) {
  if (config_.length_weight + config_.time_weight <= 0.0)
    throw ConfigError(kPlace, "length_weight and time_weight must not both be 0");
  check_motion(config_, robot);
}

PlannerTraits OmplPlanner::traits() const {
  PlannerTraits traits;
  traits.shape = config_.footprint;
  traits.kinematics = config_.kinematics;
  traits.margin_m = config_.margin_m;
  traits.unknown = config_.unknown == UnknownGround::avoid ? UnknownPolicy::avoid : UnknownPolicy::allow;
  traits.for_driving_time = config_.objective == Objective::as_driven || config_.objective == Objective::time;
  return traits;
}

void OmplPlanner::prepare(const WorldView& world, double radius_m) const {
  if (world.grid.bounds().empty()) return;
  std::optional<PoseSetup> poses;
  if (config_.kinematics != MotionKind::holonomic) poses.emplace(config_, radius_m, world.robot, world.grid);
  const EndRules rules = poses ? poses->ends : end_rules_of(config_, radius_m);
  if (is_larger_than(world.grid, rules.radius_m)) return;
  const auto space = caches_.spaces.space_of(world.grid, rules.ground, world.grid_version);
  (void)caches_.routes.routes_of(space, rules.radius_m + kMinRadius_m);
  const bool on_outer = config_.kinematics == MotionKind::differential &&
                        config_.algorithm == Algorithm::any_angle_rrt_star &&
                        !is_larger_than(world.grid, poses->outer_radius_m());
  if (on_outer) (void)caches_.outer_routes.routes_of(space, poses->outer_radius_m());
  const Point inside = world.grid.centre_of(world.grid.bounds().min);
  (void)space->joined(inside, inside);  // numbers the parts that are connected
}

PathResult OmplPlanner::plan(const PathRequest& request, const WorldView& world, const Budget& budget) const {
  check_radius("ompl", request.radius_m);
  const OmplTools tools{config_, parameters_, caches_};
  return config_.kinematics == MotionKind::holonomic ? DiscQuery(tools, request, world, budget).answer()
                                                     : PoseQuery(tools, request, world, budget).answer();
}

}  // namespace cairn
