#include "planners/ompl/pose/pose_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "planners/common/any_angle/nearest_goals.hpp"
#include "planners/ompl/disc/seeded_trees.hpp"
#include "planners/ompl/search/known_states.hpp"
#include "planners/ompl/search/search.hpp"

namespace cairn {
namespace {

constexpr int kGoalHeadings = 16;
constexpr double kGuideShare = 0.6;  // of the poses that are drawn, about the shortest route of a disc
constexpr int kStepsOfKnown = 40;

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

PoseQuery::PoseQuery(const OmplTools& tools, const PathRequest& request, const WorldView& world, const Budget& budget)
    : tools_(tools),
      request_(request),
      world_(world),
      budget_(budget),
      setup_(tools.config, request.radius_m, world.robot, world.grid) {}

PathResult PoseQuery::answer() const {
  if (budget_.exhausted() || budget_.iterations <= 0) return refused<PathResult>(stopped(stop_outcome(budget_)));
  if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused<PathResult>(*refusal);
  const auto start = start_of(request_.from, world_, setup_.ends, tools_.caches.spaces);
  if (const auto* refusal = std::get_if<Refusal>(&start)) return refused<PathResult>(*refusal);
  return answer_from(std::get<StartPlace>(start));
}

PathResult PoseQuery::answer_from(const StartPlace& start) const {
  const PoseSpace poses(*start.space, setup_.footprint, setup_.margin_m);
  if (const auto refusal = blocked(start.pose, "start", PlanOutcome::start_blocked, poses))
    return refused<PathResult>(*refusal);
  // The disc that the outline holds gets wherever the outline does.
  const auto routes = tools_.caches.routes.routes_of(start.space, setup_.inner_radius_m());
  const Point from = start.pose.position();
  const auto goals = goals_of(request_.to, world_, setup_.ends, start,
                              [&](const Point& goal) { return routes->may_reach(from, goal); });
  if (const auto* refusal = std::get_if<Refusal>(&goals)) return refused<PathResult>(*refusal);
  PathResult first;
  for (const RankedGoal& goal : nearest_first(std::get<std::vector<GoalPlace>>(goals), from, *routes, budget_)) {
    PathResult result = answer_to(start, goal.place, *routes, poses);
    if (result.outcome == PlanOutcome::solved || budget_.exhausted()) return result;
    if (first.reason.empty()) first = std::move(result);
  }
  return first;
}

PathResult PoseQuery::answer_to(const StartPlace& start, const GoalPlace& goal, const DiscRoutes& routes,
                                const PoseSpace& poses) const {
  const Point from = start.pose.position();
  const Point to = goal.pose.position();
  const DiscRoute guide = routes.route(from, to, budget_);
  if (guide.interrupted && guide.route.empty()) return refused<PathResult>(stopped(stop_outcome(budget_)));
  if (guide.impossible) return refused<PathResult>(too_narrow(request_.to, world_.graph, setup_.ends.radius_m));
  const std::vector<Pose2> goals = goal_poses(goal, guide.route, poses);
  if (goals.empty()) return refused<PathResult>(*blocked(goal.pose, "goal", PlanOutcome::goal_blocked, poses));

  PoseDraw draw;
  draw.cells = routes.cells_between(from, to, std::numeric_limits<double>::infinity(), budget_);
  if (draw.cells.empty()) return refused<PathResult>(stopped(stop_outcome(budget_)));
  draw.guide = guide.route;
  draw.guide_share = guide.route.empty() ? 0.0 : kGuideShare;
  draw.guide_width_m = std::max(setup_.footprint.circumscribed_m(), 2.0 * start.space->cell_m());
  const PoseSpace lattice_poses(*routes.lattice(), setup_.footprint, poses.margin_m());
  const TravelCost cost(start.grid_of(world_), *start.space,
                        cost_rules_of(tools_.config, request_, world_, setup_.ends.radius_m));
  const PoseProblem problem{setup_.kinematics,        lattice_poses, start.pose, goals, draw, cost,
                            world_.robot.max_w_radps, request_.seed};
  const FoundPath found = find(problem, start);
  if (budget_.cancelled() || (found.interrupted && !found.exact))
    return refused<PathResult>(stopped(stop_outcome(budget_)));
  if (!found.exact || found.states.empty())
    return refused<PathResult>(
        {PlanOutcome::out_of_budget,
         fmt::format("no path was found in {} iterations; whether there is one for such a robot is not known",
                     std::min(tools_.config.iterations, budget_.iterations))});
  PathResult result = result_of(problem, setup_, world_, start, goal, found, budget_);
  if (result.outcome == PlanOutcome::solved) result.length_lower_bound_m = guide.length_lower_bound_m;
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

FoundPath PoseQuery::find(const PoseProblem& problem, const StartPlace& start) const {
  if (are_alike(problem.from, problem.goals.front(), 1e-9)) return {{problem.from}, true, false, "already there"};
  if (tools_.config.algorithm != Algorithm::any_angle_rrt_star) return find_by_search(problem);
  FoundPath found;
  if (setup_.kinematics.kind == MotionKind::differential) found = find_along_route(problem, start);
  if (!found.exact) found = find_by_search(problem);
  if (found.exact) improve(found, problem);
  return found;
}

// Along the shortest route of the disc that holds the outline: there it can turn anywhere.
FoundPath PoseQuery::find_along_route(const PoseProblem& problem, const StartPlace& start) const {
  const double radius_m = setup_.outer_radius_m();
  const Point from = problem.from.position();
  const Point to = problem.goals.front().position();
  if (!start.space->fits(from, radius_m) || !start.space->fits(to, radius_m)) return {};
  const auto routes = tools_.caches.outer_routes.routes_of(start.space, radius_m);
  const DiscRoute route = routes->route(from, to, budget_);
  if (route.route.empty()) return {};
  FoundPath found{{problem.from}, true, false, "the shortest path over the grid on which it can turn anywhere"};
  for (std::size_t i = 1; i + 1 < route.route.size(); ++i) {
    const Point step = route.route[i] - route.route[i - 1];
    found.states.push_back({route.route[i].x(), route.route[i].y(), std::atan2(step.y(), step.x())});
  }
  found.states.push_back(problem.goals.front());
  found.exact = fits_along(problem, found.states);
  return found;
}

bool PoseQuery::fits_along(const PoseProblem& problem, const std::vector<Pose2>& states) const {
  const auto space = make_kinematic_space(setup_.kinematics, problem.poses.ground().field());
  for (const Motion& motion : motions_of(*space, states))
    if (budget_.cancelled() || !problem.poses.fits_along(motion)) return false;
  return true;
}

FoundPath PoseQuery::find_by_search(const PoseProblem& problem) const {
  const OmplConfig& config = tools_.config;
  const auto info = kinematic_information(setup_.kinematics, problem.poses, problem.draw, request_.seed);
  const auto definition = definition_of(problem, info);
  const bool any_angle = config.algorithm == Algorithm::any_angle_rrt_star;
  const AlgorithmParameters none;
  const SearchRules rules{config.algorithm, any_angle ? none : tools_.parameters,
                          std::min(config.iterations, budget_.iterations), config.simplify, request_.seed};
  SearchAnswer answer;
  if (!any_angle) {
    answer = search(info, definition, rules, budget_);
  } else if (setup_.kinematics.kind == MotionKind::dubins) {  // whose trees from both ends hardly ever meet
    SeededRrt planner(info);
    answer = search_by(planner, definition, rules, budget_);
  } else {
    SeededRrtConnect planner(info);
    answer = search_by(planner, definition, rules, budget_);
  }
  FoundPath found{{}, answer.exact, answer.interrupted, "found by sampling"};
  if (answer.path) found.states = poses_of(*answer.path);
  // What a planner puts together is not always what it checked.
  found.exact = found.exact && fits_along(problem, found.states);
  return found;
}

void PoseQuery::improve(FoundPath& found, const PoseProblem& problem) const {
  const OmplConfig& config = tools_.config;
  const bool timed = config.improve_iterations == 0;
  if (found.states.size() < 2 || (timed && budget_.deadline == Budget::Clock::time_point::max())) return;
  const auto info = kinematic_information(setup_.kinematics, problem.poses, problem.draw, request_.seed);
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
  const auto sum_of = [&](const std::vector<Pose2>& path) {
    double sum = 0.0;
    for (const Motion& motion : motions_of(space, path)) sum += cost_of(problem, motion);
    return sum;
  };
  const std::vector<Pose2> better = poses_of(*answer.path);
  if (sum_of(better) >= sum_of(found.states) * (1.0 - 1e-9) || !fits_along(problem, better)) return;
  found.states = better;
  found.how += ", improved by OMPL";
}

std::optional<Refusal> PoseQuery::blocked(const Pose2& pose, const std::string& end, PlanOutcome outcome,
                                          const PoseSpace& poses) const {
  if (poses.fits(pose)) return std::nullopt;
  const std::string touching =
      fmt::format("the {} {} is blocked: turned to {} degrees, the robot's outline touches something there", end,
                  text_of(pose.position()), std::lround(degrees(pose.theta_rad)));
  const auto fits = [&](const Point& p) { return poses.fits({p.x(), p.y(), pose.theta_rad}); };
  return Refusal{outcome, touching + nearest_free_text(poses.ground(), pose.position(), setup_.ends.radius_m, fits)};
}

}  // namespace cairn
