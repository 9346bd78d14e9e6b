#include "planners/ompl/disc/disc_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "planners/common/any_angle/nearest_goals.hpp"
#include "planners/common/disc_space/routes.hpp"
#include "planners/ompl/disc/disc_states.hpp"
#include "planners/ompl/disc/weighted_route.hpp"
#include "planners/ompl/search/search.hpp"

namespace cairn {
namespace {

// Most of what there is to gain of a route that is cheap already lies beside it; the other samples are even.
constexpr double kBesideShare = 0.7;
constexpr double kBesideWidth_m = 0.3;

// Where another count than the length decides, the shortest path only bounds the search: one so much longer than any
// must be is sought again on a finer lattice, which costs as much as the whole map.
constexpr double kDoubtfulGuideRatio = 1.25;

Objective objective_of(const OmplConfig& config, const PathRequest& request, bool is_robot_known) {
  if (config.objective != Objective::as_driven && config.objective != Objective::as_asked) return config.objective;
  switch (request.cost) {
    case CostKind::time:
      return Objective::time;
    case CostKind::clearance:
      return Objective::clearance;
    case CostKind::length:
      break;
  }
  return config.objective == Objective::as_driven && is_robot_known ? Objective::time : Objective::length;
}

}  // namespace

EndRules end_rules_of(const OmplConfig& config, double radius_m) {
  EndRules rules;
  rules.ground.unknown = config.unknown == UnknownGround::avoid ? UnknownPolicy::avoid : UnknownPolicy::allow;
  rules.radius_m = radius_m + config.margin_m;
  rules.start_tolerance_m = config.start_tolerance_m;
  return rules;
}

TravelCostRules cost_rules_of(const OmplConfig& config, const PathRequest& request, const WorldView& world,
                              double radius_m) {
  const std::optional<DrivingRules> driving =
      driving_rules_of(world, std::min(radius_m, request.radius_m), request.speed_mps);
  return {objective_of(config, request, driving.has_value()),
          config.length_weight,
          config.time_weight,
          config.clearance_weight,
          config.unknown == UnknownGround::cost ? config.unknown_weight : 1.0,
          world.robot.max_v_mps,
          radius_m,
          driving};
}

DiscQuery::DiscQuery(const OmplTools& tools, const PathRequest& request, const WorldView& world, const Budget& budget)
    : tools_(tools),
      request_(request),
      world_(world),
      budget_(budget),
      rules_(end_rules_of(tools.config, request.radius_m)) {}

// Planned with a hair more than is re-checked, so that rounding makes no difference.
double DiscQuery::radius_m() const {
  return rules_.radius_m + kMinRadius_m;
}

PathResult DiscQuery::answer() const {
  if (budget_.exhausted() || budget_.iterations <= 0) return refused<PathResult>(stopped(stop_outcome(budget_)));
  // Both ends are looked at before either is worked on.
  if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused<PathResult>(*refusal);
  const auto start = start_of(request_.from, world_, rules_, tools_.caches.spaces);
  if (const auto* refusal = std::get_if<Refusal>(&start)) return refused<PathResult>(*refusal);
  return answer_from(std::get<StartPlace>(start));
}

PathResult DiscQuery::answer_from(const StartPlace& start) const {
  const auto routes = tools_.caches.routes.routes_of(start.space, radius_m());
  const auto goals = goals_of(request_.to, world_, rules_, start,
                              [&](const Point& goal) { return routes->may_reach(start.leave_from, goal); });
  if (const auto* refusal = std::get_if<Refusal>(&goals)) return refused<PathResult>(*refusal);
  PathResult first;
  for (const RankedGoal& goal :
       nearest_first(std::get<std::vector<GoalPlace>>(goals), start.leave_from, *routes, budget_)) {
    if (budget_.exhausted()) return refused<PathResult>(stopped(stop_outcome(budget_)));
    const FoundRoute found = find(start, goal.place, *routes);
    if (budget_.cancelled() || (found.interrupted && !found.exact))
      return refused<PathResult>(stopped(stop_outcome(budget_)));
    PathResult result = checked(start, goal.place, found);
    if (found.exact) return result;
    if (first.reason.empty()) first = std::move(result);
  }
  return first;
}

FoundRoute DiscQuery::find(const StartPlace& start, const GoalPlace& goal, const DiscRoutes& routes) const {
  const Point from = start.leave_from;
  const Point to = goal.pose.position();
  if (from == to) return {{from}, true, false, false, 0.0, "start and goal are the same place"};
  const TravelCost cost(start.grid_of(world_), *start.space,
                        cost_rules_of(tools_.config, request_, world_, rules_.radius_m));
  const double straight_m =
      cost.is_driving_time() ? cost.driving()->radius_m + cost.driving()->pace.open_from_m() : 0.0;
  if ((cost.is_length() || cost.is_driving_time()) &&
      start.space->fits_along(from, to, std::max(radius_m(), straight_m)))
    return {{from, to}, true, false, false, (to - from).norm(), "straight on"};
  if (tools_.config.algorithm == Algorithm::any_angle_rrt_star) {
    FoundRoute found = find_on_grid(routes, cost, from, to);
    if (found.impossible || found.interrupted) return found;
    if (found.route.empty()) return find_by_sampling(routes, cost, from, to);
    improve(found, routes, cost);
    return found;
  }
  FoundRoute found = find_by_sampling(routes, cost, from, to);
  if (found.exact || found.interrupted) return found;
  // Sampling has found nothing: is there nothing, or is it only hard to hit?
  FoundRoute on_grid = find_on_grid(routes, cost, from, to);
  if (on_grid.impossible || on_grid.interrupted) return on_grid;
  if (on_grid.route.empty() || !tools_.config.fall_back_to_grid) return found;
  on_grid.how = "sampling found nothing; this is " + on_grid.how;
  return on_grid;
}

FoundRoute DiscQuery::find_on_grid(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                   const Point& to) const {
  DiscRoute grid = routes.route(from, to, budget_, cost.is_length() ? DiscRoutes::kDoubtfulRatio : kDoubtfulGuideRatio);
  FoundRoute found{std::move(grid.route), false, grid.interrupted, grid.impossible, grid.length_lower_bound_m, ""};
  if (found.interrupted && !found.route.empty()) found.interrupted = false;  // it is a route all the same
  if (found.impossible || found.interrupted) return found;
  found.how = "the shortest path over the grid";
  if (!cost.is_length()) {
    const double known = found.route.empty() ? std::numeric_limits<double>::infinity() : cost_of(cost, found.route);
    std::vector<Point> cheap = weighted_route(routes, cost, found.route, from, to, budget_);
    if (!cheap.empty() && cost_of(cost, cheap) < known) {
      found.route = std::move(cheap);
      found.how = cost.is_driving_time() ? "the fastest path over the grid" : "the cheapest path over the grid";
    }
  }
  found.exact = !found.route.empty();
  return found;
}

FoundRoute DiscQuery::find_by_sampling(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                       const Point& to) const {
  const SampledCells samples{routes.lattice(),
                             routes.cells_between(from, to, std::numeric_limits<double>::infinity(), budget_)};
  if (samples.cells.empty()) return {{}, false, true, false, std::nullopt, ""};
  const DiscProblem problem{routes.space(), radius_m(), from, to, samples, cost, request_.seed};
  const auto info = space_information(problem);
  const auto definition = definition_of(problem, info);
  const bool simplify = tools_.config.simplify && cost.is_length();
  const SearchAnswer answer = search(info, definition,
                                     {tools_.config.algorithm, tools_.parameters,
                                      std::min(tools_.config.iterations, budget_.iterations), simplify, request_.seed},
                                     budget_);
  FoundRoute found{{}, answer.exact, answer.interrupted, false, std::nullopt, "found by sampling"};
  if (!answer.path) return found;
  for (const ompl::base::State* const state : answer.path->getStates()) found.route.push_back(point_of(state));
  if (!answer.exact || !tools_.config.simplify) return found;
  found.route = cost.is_length() ? straightened(routes.space(), found.route, radius_m(), 1, budget_)
                                 : shortened_by_cost(routes.space(), cost, found.route, radius_m(), budget_);
  return found;
}

std::vector<Point> DiscQuery::shortened(const DiscRoutes& routes, const TravelCost& cost,
                                        const std::vector<Point>& route) const {
  const DiscSpace& space = routes.space();
  if (!cost.is_length()) return shortened_by_cost(space, cost, route, radius_m(), budget_);
  return tightened(space, straightened(space, route, radius_m(), 1, budget_), radius_m(), 1, budget_);
}

void DiscQuery::improve(FoundRoute& found, const DiscRoutes& routes, const TravelCost& cost) const {
  const OmplConfig& config = tools_.config;
  const double known = cost_of(cost, found.route);
  const bool is_bounded = cost.is_length() || cost.is_driving_time();
  if (is_bounded && known <= config.good_enough_ratio * cost.min_per_m() * *found.length_lower_bound_m) return;
  const bool timed = config.improve_iterations == 0;
  if (timed && budget_.deadline == Budget::Clock::time_point::max()) return;
  const std::int64_t iterations =
      std::min(timed ? std::numeric_limits<std::int64_t>::max() : config.improve_iterations, budget_.iterations);

  const Point from = found.route.front();
  const Point to = found.route.back();
  const SampledCells samples{routes.lattice(), routes.cells_between(from, to, known / cost.min_per_m(), budget_)};
  if (samples.cells.empty()) return;
  DiscProblem problem{routes.space(), radius_m(), from, to, samples, cost, request_.seed};
  if (cost.is_driving_time()) problem.guide = {found.route, kBesideShare, kBesideWidth_m};
  const auto info = space_information(problem);
  const auto definition = definition_of(problem, info);
  KnownStates states(info);
  add_route(states, found.route);
  // Each better solution counts by what it can be shortened to, so that going on never makes the answer worse.
  std::vector<Point> best;
  double best_cost = known;
  definition->setIntermediateSolutionCallback([&](const ompl::base::Planner*,
                                                  const std::vector<const ompl::base::State*>& between_backwards,
                                                  ompl::base::Cost) {
    std::vector<Point> better{from};
    for (auto state = between_backwards.rbegin(); state != between_backwards.rend(); ++state)
      better.push_back(point_of(*state));
    better.push_back(to);
    better = shortened(routes, cost, better);
    const double better_cost = cost_of(cost, better);
    if (better_cost >= best_cost * (1.0 - 1e-9)) return;
    best_cost = better_cost;
    best = std::move(better);
  });
  (void)search(info, definition, {config.algorithm, tools_.parameters, iterations, false, request_.seed}, budget_,
               states.all());
  if (best.empty()) return;
  found.route = std::move(best);
  found.how += ", improved by OMPL";
}

PathResult DiscQuery::checked(const StartPlace& start, const GoalPlace& goal, const FoundRoute& found) const {
  if (found.impossible) return refused<PathResult>(too_narrow(request_.to, world_.graph, rules_.radius_m));
  if (found.route.size() < (found.exact ? 1U : 2U)) {
    return refused<PathResult>(
        {PlanOutcome::out_of_budget,
         fmt::format("no route was found in {} iterations; if there is one, it is hardly wider than the robot",
                     std::min(tools_.config.iterations, budget_.iterations))});
  }
  std::vector<Point> route = found.route;
  if (start.escape) route.insert(route.begin(), start.pose.position());
  if (!route_is_free(start.grid_of(world_), rules_.ground, route, rules_.radius_m, start.escape))
    throw std::logic_error(fmt::format("ompl: the re-check refused a route of {} points from {} to {}, radius {:f}",
                                       route.size(), text_of(route.front()), text_of(route.back()), rules_.radius_m));
  const TravelCost cost(start.grid_of(world_), *start.space,
                        cost_rules_of(tools_.config, request_, world_, rules_.radius_m));
  return result_of(start, goal, found, route, cost);
}

PathResult DiscQuery::result_of(const StartPlace& start, const GoalPlace& goal, const FoundRoute& found,
                                const std::vector<Point>& route, const TravelCost& cost) const {
  PathResult result;
  result.outcome = found.exact ? PlanOutcome::solved : PlanOutcome::approximate;
  result.length_m = length_of(route);
  result.cost_m = cost.is_in_metres() ? cost_of(cost, route) : result.length_m;
  if (found.exact && !start.escape) result.length_lower_bound_m = found.length_lower_bound_m;
  result.clearance_m = clearance_along(*start.space, route, request_.radius_m);
  if (const auto driving = driving_rules_of(world_, request_.radius_m, request_.speed_mps))
    result.driving_time_s = driving_time_s(start.space->field(), route, *driving);
  result.path = poses_along(route, start.pose.theta_rad, found.exact ? goal.heading_rad : std::nullopt);
  result.from_landmark = start.landmark;
  if (found.exact) result.to_landmark = goal.landmark;
  result.reason = found.how + goal.note;
  if (!found.exact) result.reason = "the route ends at " + text_of(route.back()) + ", short of the goal";
  if (found.interrupted) result.reason += "; the budget ended the search for a shorter one";
  result.reason += escape_text(start);
  return result;
}

}  // namespace cairn
