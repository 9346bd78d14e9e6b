#include "planners/ompl/pose_query.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "planners/disc_space/routes.hpp"
#include "planners/ompl/known_states.hpp"
#include "planners/ompl/search.hpp"
#include "planners/ompl/seeded_trees.hpp"
#include "planners/pose_space/pose_recheck.hpp"

namespace cairn {
namespace {

constexpr int kGoalHeadings = 16;
constexpr double kGuideShare = 0.6;             // of the poses that are drawn, about the shortest route of a disc
constexpr double kPathStep_m = 0.1;             // between the poses of an answer
constexpr double kPathStep_rad = radians(5.0);  // 5 degrees
constexpr double kTextSearch_m = 3.0;           // how far a message looks for a free place
constexpr int kStepsOfKnown = 40;

Footprint footprint_of(const OmplConfig& config, const PlanRequest& request, const RobotModel& robot) {
  const bool outlined = config.footprint == WantedFootprint::robot && !robot.polygon_m.empty();
  return outlined ? Footprint::polygon(robot.polygon_m) : Footprint::disc(request.radius_m);
}

KinematicRules kinematics_of(const OmplConfig& config, const RobotModel& robot) {
  KinematicRules rules;
  rules.kind = config.kinematics;
  rules.turning_radius_m = config.turning_radius_m > 0.0 ? config.turning_radius_m : robot.min_turning_radius_m;
  rules.driving = config.reverse ? Driving::either : Driving::forwards;
  rules.spot_turn_m = config.spot_turn_m;
  return rules;
}

// Least distance of the outline's rim, or the disc's edge, to anything blocked.
double clearance_of(const DiscSpace& space, const Footprint& footprint, const std::vector<Pose2>& path) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Pose2& pose : path) {
    if (footprint.is_disc()) {
      const double away_m = space.distance_m(pose.position(), pose.position());
      nearest_m = std::min(nearest_m, away_m - footprint.circumscribed_m());
      continue;
    }
    const std::vector<Point>& corners = footprint.corners_m();
    for (std::size_t i = 0; i < corners.size(); ++i)
      nearest_m = std::min(nearest_m, space.distance_m(pose * corners[i], pose * corners[(i + 1) % corners.size()]));
  }
  return std::max(nearest_m, 0.0);
}

std::vector<Pose2> path_along(const std::vector<Motion>& motions, const Pose2& only) {
  std::vector<Pose2> path;
  for (const Motion& motion : motions)
    for (const Pose2& pose : motion.sampled(kPathStep_m, kPathStep_rad))
      if (path.empty() || !are_alike(path.back(), pose, 1e-9)) path.push_back(pose);
  if (path.empty()) path.push_back(only);
  return path;
}

// With states between so that none is far from the next.
std::vector<Pose2> with_steps(const ompl::base::StateSpace& space, const std::vector<Pose2>& states) {
  const std::vector<Motion> motions = motions_of(space, states);
  double extent_m = 0.0;
  for (const Motion& motion : motions) extent_m += motion.extent_m();
  std::vector<Pose2> all{states.front()};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const int steps = std::max(1, static_cast<int>(motions[i].extent_m() / std::max(extent_m / kStepsOfKnown, 1e-9)));
    for (int k = 1; k < steps; ++k) all.push_back(motions[i].pose_at(motions[i].extent_m() * k / steps));
    all.push_back(states[i + 1]);
  }
  return all;
}

}  // namespace

PoseQuery::PoseQuery(const OmplTools& tools, const PlanRequest& request, const WorldView& world, const Budget& budget)
    : tools_(tools),
      request_(request),
      world_(world),
      budget_(budget),
      footprint_(footprint_of(tools.config, request, world.robot)),
      kinematics_(kinematics_of(tools.config, world.robot)),
      rules_(end_rules_of(tools.config, footprint_.inscribed_m())) {
  rules_.start_tolerance_m = 0.0;
}

PlanResult PoseQuery::answer() const {
  if (budget_.exhausted() || budget_.iterations <= 0) return stopped(budget_);
  if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused(*refusal);
  const auto start = start_of(request_.from, world_, rules_, tools_.caches.spaces);
  if (const auto* refusal = std::get_if<Refusal>(&start)) return refused(*refusal);
  return answer_from(std::get<StartPlace>(start));
}

PlanResult PoseQuery::answer_from(const StartPlace& start) const {
  const double slack_m = recheck_slack_m(start.space->cell_m());
  const PoseSpace poses(*start.space, footprint_, tools_.config.margin_m + planning_margin_m(slack_m));
  if (const auto refusal = blocked(start.pose, "start", PlanOutcome::start_blocked, poses)) return refused(*refusal);
  // The disc that the outline holds gets wherever the outline does.
  const auto routes = tools_.caches.routes.routes_of(start.space, rules_.radius_m + kLeastRadius_m);
  const Point from = start.pose.position();
  const auto goals =
      goals_of(request_.to, world_, rules_, start, [&](const Point& goal) { return routes->may_reach(from, goal); });
  if (const auto* refusal = std::get_if<Refusal>(&goals)) return refused(*refusal);
  const auto& places = std::get<std::vector<GoalPlace>>(goals);
  std::vector<std::pair<double, const GoalPlace*>> order;
  for (const GoalPlace& goal : places) {
    const double least_m = places.size() == 1 ? 0.0 : routes->least_length_m(from, goal.pose.position(), budget_);
    order.emplace_back(least_m, &goal);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  PlanResult first;
  for (const auto& [least_m, goal] : order) {
    PlanResult result = answer_to(start, *goal, *routes, poses);
    if (result.outcome == PlanOutcome::solved || budget_.exhausted()) return result;
    if (first.reason.empty()) first = std::move(result);
  }
  return first;
}

PlanResult PoseQuery::answer_to(const StartPlace& start, const GoalPlace& goal, const DiscRoutes& routes,
                                const PoseSpace& poses) const {
  const Point from = start.pose.position();
  const Point to = goal.pose.position();
  const DiscRoute guide = routes.route(from, to, budget_);
  if (guide.interrupted && guide.route.empty()) return stopped(budget_);
  if (guide.impossible) return refused(too_narrow(request_.to, world_.graph, rules_.radius_m));
  const std::vector<Pose2> goals = goal_poses(goal, guide.route, poses);
  if (goals.empty()) return refused(*blocked(goal.pose, "goal", PlanOutcome::goal_blocked, poses));

  PoseDraw draw;
  draw.cells = routes.cells_between(from, to, std::numeric_limits<double>::infinity());
  draw.guide = guide.route;
  draw.guide_share = guide.route.empty() ? 0.0 : kGuideShare;
  draw.guide_width_m = std::max(footprint_.circumscribed_m(), 2.0 * start.space->cell_m());
  const PoseSpace lattice_poses(*routes.lattice(), footprint_, poses.margin_m());
  const TravelCost cost(start.grid_of(world_), *start.space,
                        cost_rules_of(tools_.config, request_, world_.robot, rules_.radius_m));
  const PoseProblem problem{kinematics_,  lattice_poses, start.pose, goals, draw, cost, world_.robot.max_w_radps,
                            request_.seed};
  FoundWay found = find(problem, start);
  if (budget_.cancelled() || (found.interrupted && !found.exact)) return stopped(budget_);
  PlanResult result = checked(problem, start, goal, found);
  if (found.exact) result.least_length_m = guide.least_length_m;
  return result;
}

std::vector<Pose2> PoseQuery::goal_poses(const GoalPlace& goal, const std::vector<Point>& guide,
                                         const PoseSpace& poses) const {
  std::vector<Pose2> fitting;
  if (goal.heading_rad) {
    const Pose2 pose{goal.pose.x_m, goal.pose.y_m, *goal.heading_rad};
    if (poses.fits(pose)) fitting.push_back(pose);
    return fitting;
  }
  // First as one comes there.
  double first_rad = goal.pose.theta_rad;
  if (guide.size() > 1) {
    const Point last = guide.back() - guide[guide.size() - 2];
    first_rad = std::atan2(last.y(), last.x());
  }
  for (int i = 0; i < kGoalHeadings; ++i) {
    const Pose2 pose{goal.pose.x_m, goal.pose.y_m, wrap_angle(first_rad + 2.0 * std::numbers::pi * i / kGoalHeadings)};
    if (poses.fits(pose)) fitting.push_back(pose);
  }
  return fitting;
}

PoseQuery::FoundWay PoseQuery::find(const PoseProblem& problem, const StartPlace& start) const {
  if (are_alike(problem.from, problem.goals.front(), 1e-9)) return {{problem.from}, true, false, "already there"};
  if (tools_.config.algorithm != Algorithm::any_angle_rrt_star) return find_by_search(problem);
  FoundWay found;
  if (kinematics_.kind == MotionKind::differential) found = find_along_route(problem, start);
  if (!found.exact) found = find_by_search(problem);
  if (found.exact) improve(found, problem);
  return found;
}

// Along the shortest route of the disc that holds the outline: there it can turn anywhere.
PoseQuery::FoundWay PoseQuery::find_along_route(const PoseProblem& problem, const StartPlace& start) const {
  const double radius_m = footprint_.circumscribed_m() + problem.poses.margin_m();
  const Point from = problem.from.position();
  const Point to = problem.goals.front().position();
  if (!start.space->fits(from, radius_m) || !start.space->fits(to, radius_m)) return {};
  const auto routes = tools_.caches.outer_routes.routes_of(start.space, radius_m);
  const DiscRoute route = routes->route(from, to, budget_);
  if (route.route.empty()) return {};
  FoundWay found{{problem.from}, true, false, "the shortest way over the grid on which it can turn anywhere"};
  for (std::size_t i = 1; i + 1 < route.route.size(); ++i) {
    const Point step = route.route[i] - route.route[i - 1];
    found.states.push_back({route.route[i].x(), route.route[i].y(), std::atan2(step.y(), step.x())});
  }
  found.states.push_back(problem.goals.front());
  found.exact = fits_along(problem, found.states);
  return found;
}

bool PoseQuery::fits_along(const PoseProblem& problem, const std::vector<Pose2>& states) const {
  const auto space = make_kinematic_space(kinematics_, problem.poses.ground().field());
  for (const Motion& motion : motions_of(*space, states))
    if (!problem.poses.fits_along(motion)) return false;
  return true;
}

PoseQuery::FoundWay PoseQuery::find_by_search(const PoseProblem& problem) const {
  const OmplConfig& config = tools_.config;
  const auto info = kinematic_information(kinematics_, problem.poses, problem.draw, request_.seed);
  const auto definition = definition_of(problem, info);
  const bool any_angle = config.algorithm == Algorithm::any_angle_rrt_star;
  const AlgorithmParameters none;
  const SearchRules rules{config.algorithm, any_angle ? none : tools_.parameters,
                          std::min(config.iterations, budget_.iterations), config.simplify, request_.seed};
  SearchAnswer answer;
  if (!any_angle) {
    answer = search(info, definition, rules, budget_);
  } else if (kinematics_.kind == MotionKind::dubins) {  // whose trees from both ends hardly ever meet
    SeededRrt planner(info);
    answer = search_by(planner, definition, rules, budget_);
  } else {
    SeededRrtConnect planner(info);
    answer = search_by(planner, definition, rules, budget_);
  }
  FoundWay found{{}, answer.exact, answer.interrupted, "found by sampling"};
  if (answer.path) found.states = poses_of(*answer.path);
  // What a planner puts together is not always what it checked.
  found.exact = found.exact && fits_along(problem, found.states);
  return found;
}

void PoseQuery::improve(FoundWay& found, const PoseProblem& problem) const {
  const OmplConfig& config = tools_.config;
  const bool timed = config.improve_iterations == 0;
  if (found.states.size() < 2 || (timed && budget_.deadline == Budget::Clock::time_point::max())) return;
  const auto info = kinematic_information(kinematics_, problem.poses, problem.draw, request_.seed);
  const auto definition = definition_of(problem, info);
  const ompl::base::StateSpace& space = *info->getStateSpace();
  const std::vector<Pose2> known = with_steps(space, found.states);
  if (!fits_along(problem, known)) return;  // between nearly alike poses rounding may choose other motions
  KnownStates states(info);
  for (const Pose2& pose : known) set_pose(states.add(), pose);
  const std::int64_t iterations =
      std::min(timed ? std::numeric_limits<std::int64_t>::max() : config.improve_iterations, budget_.iterations);
  const SearchAnswer answer =
      search(info, definition, {config.algorithm, tools_.parameters, iterations, config.simplify, request_.seed},
             budget_, states.all());
  if (!answer.path || !answer.exact) return;
  const auto sum_of = [&](const std::vector<Pose2>& way) {
    double sum = 0.0;
    for (const Motion& motion : motions_of(space, way)) sum += cost_of(problem, motion);
    return sum;
  };
  const std::vector<Pose2> better = poses_of(*answer.path);
  if (sum_of(better) >= sum_of(found.states) * (1.0 - 1e-9) || !fits_along(problem, better)) return;
  found.states = better;
  found.how += ", improved by OMPL";
}

PlanResult PoseQuery::checked(const PoseProblem& problem, const StartPlace& start, const GoalPlace& goal,
                              const FoundWay& found) const {
  if (!found.exact || found.states.empty())
    return refused({PlanOutcome::out_of_budget,
                    "no way was found in " + std::to_string(std::min(tools_.config.iterations, budget_.iterations)) +
                        " iterations; whether there is one for such a robot is not known"});
  const auto space = make_kinematic_space(kinematics_, start.space->field());
  const std::vector<Motion> motions = motions_of(*space, found.states);
  int reversals = 0;
  for (const Motion& motion : motions) {
    const auto touch =
        first_touch(start.grid_of(world_), rules_.ground, footprint_, motion, recheck_slack_m(start.space->cell_m()));
    if (touch)
      throw std::logic_error("ompl: the re-check refused a motion at " + text_of(touch->pose.position()) +
                             ", outline of radius " + std::to_string(footprint_.circumscribed_m()));
    reversals += motion.reversals();
  }
  PlanResult result;
  result.outcome = PlanOutcome::solved;
  result.path = path_along(motions, start.pose);
  for (std::size_t i = 1; i < result.path.size(); ++i)
    result.length_m += (result.path[i].position() - result.path[i - 1].position()).norm();
  result.cost_m = result.length_m;
  if (!problem.cost.is_length() && problem.cost.is_in_metres()) {
    result.cost_m = 0.0;
    for (const Motion& motion : motions) result.cost_m += cost_of(problem, motion);
  }
  result.clearance_m = clearance_of(*start.space, footprint_, result.path);
  if (start.landmark != 0) result.landmarks.push_back(start.landmark);
  if (goal.landmark != 0 && goal.landmark != start.landmark) result.landmarks.push_back(goal.landmark);
  result.reason = found.how + goal.note;
  if (reversals == 1) result.reason += "; it turns back once";
  if (reversals > 1) result.reason += "; it turns back " + std::to_string(reversals) + " times";
  if (found.interrupted) result.reason += "; the budget ended the search for a shorter one";
  return result;
}

std::optional<Refusal> PoseQuery::blocked(const Pose2& pose, const std::string& end, PlanOutcome outcome,
                                          const PoseSpace& poses) const {
  if (poses.fits(pose)) return std::nullopt;
  const DiscSpace& space = poses.ground();
  std::string reason = "the " + end + " " + text_of(pose.position()) + " is blocked: turned to " +
                       std::to_string(std::lround(degrees(pose.theta_rad))) + " degrees, the robot's outline touches " +
                       "something there";
  const auto fits = [&](const Point& p) { return poses.fits({p.x(), p.y(), pose.theta_rad}); };
  const auto free = nearest_fit(space, pose.position(), rules_.radius_m, kTextSearch_m, fits);
  reason += free ? "; the nearest free place for it is " + text_of(*free)
                 : "; there is no free place for it within " + metres_text(kTextSearch_m);
  return Refusal{outcome, reason};
}

}  // namespace cairn
