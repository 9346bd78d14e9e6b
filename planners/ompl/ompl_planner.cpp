#include "planners/ompl/ompl_planner.hpp"

#include <chrono>
#include <stdexcept>

#include "planners/disc_space/ends.hpp"
#include "planners/disc_space/routes.hpp"

namespace cairn {
namespace {

PlanResult refused(const Refusal& refusal) {
  PlanResult result;
  result.outcome = refusal.outcome;
  result.reason = refusal.reason;
  return result;
}

PlanResult stopped(const Budget& budget) {
  if (budget.cancelled()) return refused({PlanOutcome::cancelled, "the search for a route was cancelled"});
  return refused({PlanOutcome::out_of_budget, "the budget was used up before a route was found"});
}

constexpr int kRefinedParts = 4;
constexpr std::int64_t kMostRefinedCells = 8'000'000;

// A route with where it came from.
struct Found {
  std::vector<Point> route;  // from StartPlace::leave_from; empty: none
  bool exact = false;        // otherwise it ends short of the goal
  bool interrupted = false;
  bool impossible = false;  // proven
  std::string how;
};

// One request on its way to an answer.
class Query {
 public:
  Query(const OmplConfig& config, const AlgorithmParameters& parameters, const SpaceCache& spaces,
        const PlanRequest& request, const WorldView& world, const Budget& budget)
      : config_(config), parameters_(parameters), spaces_(spaces), request_(request), world_(world), budget_(budget) {
    rules_.ground.unknown = config.unknown;
    rules_.radius_m = request.radius_m + config.margin_m;
    rules_.start_tolerance_m = config.start_tolerance_m;
  }

  PlanResult answer() const {
    if (budget_.exhausted() || budget_.iterations <= 0) return stopped(budget_);
    // Both ends are looked at before either is worked on.
    if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused(*refusal);
    const auto start = start_of(request_.from, world_, rules_, spaces_);
    if (const auto* refusal = std::get_if<Refusal>(&start)) return refused(*refusal);
    return answer_from(std::get<StartPlace>(start));
  }

 private:
  PlanResult answer_from(const StartPlace& start) const {
    const TravelField travel = start.space->travel_at_most(start.leave_from, radius_m());
    const auto goals = goals_of(request_.to, world_, rules_, start, travel);
    if (const auto* refusal = std::get_if<Refusal>(&goals)) return refused(*refusal);
    PlanResult first;
    for (const GoalPlace& goal : nearest_first(std::get<std::vector<GoalPlace>>(goals), *start.space, travel)) {
      if (budget_.exhausted()) return stopped(budget_);
      const Found found = find(start, goal, travel);
      if (budget_.cancelled() || (found.interrupted && !found.exact)) return stopped(budget_);
      PlanResult result = checked(start, goal, found);
      if (found.exact) return result;
      if (first.reason.empty()) first = std::move(result);
    }
    return first;
  }

  static std::vector<GoalPlace> nearest_first(std::vector<GoalPlace> goals, const DiscSpace& space,
                                              const TravelField& travel) {
    const auto cost_m = [&](const GoalPlace& g) { return travel.cost_m(space.field().cell_at(g.pose.position())); };
    std::stable_sort(goals.begin(), goals.end(),
                     [&](const GoalPlace& a, const GoalPlace& b) { return cost_m(a) < cost_m(b); });
    return goals;
  }

  Found find(const StartPlace& start, const GoalPlace& goal, const TravelField& travel) const {
    const DiscSpace& space = *start.space;
    const Point from = start.leave_from;
    const Point to = goal.pose.position();
    if (from == to) return {{from}, true, false, false, "start and goal are the same place"};
    if (space.fits_along(from, to, radius_m())) return {{from, to}, true, false, false, "straight on"};
    const SamplingTask task{space,
                            radius_m(),
                            from,
                            to,
                            reached_cells(space, travel),
                            config_.algorithm,
                            parameters_,
                            std::min(config_.iterations, budget_.iterations),
                            config_.simplify,
                            request_.seed};
    const SamplingAnswer answer = search_by_sampling(task, budget_);
    if (answer.exact) return {tidied(space, answer.route), true, answer.interrupted, false, "found by sampling"};
    if (answer.interrupted) return {{}, false, true, false, ""};
    Found found = find_over_cells(space, from, to);
    if (found.route.empty() && !found.impossible) found.route = answer.route;
    return found;
  }

  // Sampling has found nothing: is there nothing, or is it only hard to hit?
  Found find_over_cells(const DiscSpace& space, const Point& from, const Point& to) const {
    Found found;
    if (config_.fall_back_to_grid) found.route = route_over_cells(space, from, to, radius_m());
    const CellBox box = space.field().box();
    const std::int64_t cells = std::int64_t{box.width()} * box.height() * kRefinedParts * kRefinedParts;
    if (found.route.empty() && cells <= kMostRefinedCells && !budget_.exhausted()) {
      const DiscSpace fine = space.refined(kRefinedParts);
      found.impossible = !fine.travel_at_most(from, radius_m()).reaches(fine.field().cell_at(to));
      if (!found.impossible && config_.fall_back_to_grid) found.route = route_over_cells(fine, from, to, radius_m());
    }
    found.exact = !found.route.empty();
    found.how = "sampling found nothing; this is the shortest way over the grid's cells";
    return found;
  }

  std::vector<Point> tidied(const DiscSpace& space, const std::vector<Point>& route) const {
    return config_.simplify ? straightened(space, route, radius_m()) : route;
  }

  // What states are drawn from: cells the robot can be in and get to.
  static std::vector<Cell> reached_cells(const DiscSpace& space, const TravelField& travel) {
    std::vector<Cell> cells;
    const CellBox box = travel.box();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (travel.reaches({x, y}) && !space.is_blocked({x, y})) cells.push_back({x, y});
    return cells;
  }

  PlanResult checked(const StartPlace& start, const GoalPlace& goal, const Found& found) const {
    if (found.impossible) return refused(too_narrow(request_.to, world_.graph, rules_.radius_m));
    if (found.route.size() < (found.exact ? 1U : 2U)) {
      return refused({PlanOutcome::out_of_budget, "no route was found in " +
                                                      std::to_string(std::min(config_.iterations, budget_.iterations)) +
                                                      " iterations; if there is one, it is hardly wider than the "
                                                      "robot"});
    }
    std::vector<Point> route = found.route;
    if (start.escape) route.insert(route.begin(), start.pose.position());
    if (!route_is_free(start.grid_of(world_), rules_.ground, route, rules_.radius_m, start.escape))
      throw std::logic_error("ompl: the re-check refused a route of " + std::to_string(route.size()) + " points from " +
                             text_of(route.front()) + " to " + text_of(route.back()) + ", radius " +
                             std::to_string(rules_.radius_m));
    return result_of(start, goal, found, route);
  }

  PlanResult result_of(const StartPlace& start, const GoalPlace& goal, const Found& found,
                       const std::vector<Point>& route) const {
    PlanResult result;
    result.outcome = found.exact ? PlanOutcome::solved : PlanOutcome::approximate;
    result.length_m = length_of(route);
    result.cost_m = result.length_m;
    result.clearance_m = clearance_along(*start.space, route, request_.radius_m);
    result.path = poses_along(route, start.pose.theta_rad, found.exact ? goal.heading_rad : std::nullopt);
    if (start.landmark != 0) result.landmarks.push_back(start.landmark);
    if (found.exact && goal.landmark != 0 && goal.landmark != start.landmark) result.landmarks.push_back(goal.landmark);
    result.reason = found.how + goal.note;
    if (!found.exact) result.reason = "the route ends at " + text_of(route.back()) + ", short of the goal";
    if (found.interrupted) result.reason += "; the budget ended the search for a shorter one";
    if (start.escape)
      result.reason += "; the start is too near to something and is left towards " + text_of(start.escape->to) +
                       " with less clearance than the robot's radius asks for";
    return result;
  }

  // Planned with a hair more than is re-checked, so that rounding cannot tell them apart.
  double radius_m() const { return rules_.radius_m + kLeastRadius_m; }

  const OmplConfig& config_;
  const AlgorithmParameters& parameters_;
  const SpaceCache& spaces_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  EndRules rules_;
};

}  // namespace

OmplPlanner::OmplPlanner(OmplConfig config)
    : config_(std::move(config)), parameters_(checked_parameters(config_.algorithm, config_.parameters)) {}

PlanResult OmplPlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  if (!(request.radius_m >= 0.0 && std::isfinite(request.radius_m)))
    throw std::invalid_argument("ompl: radius_m must be finite and not negative, got " +
                                std::to_string(request.radius_m));
  const auto begin = Budget::Clock::now();
  PlanResult result = Query(config_, parameters_, spaces_, request, world, budget).answer();
  result.time_ms.route_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  result.time_ms.total_ms = result.time_ms.route_ms;
  return result;
}

}  // namespace cairn
