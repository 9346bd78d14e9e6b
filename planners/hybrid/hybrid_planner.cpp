#include "planners/hybrid/hybrid_planner.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>

#include "planners/disc_space/ends.hpp"
#include "planners/disc_space/routes.hpp"
#include "planners/hybrid/legs.hpp"
#include "planners/hybrid/symbolic_path.hpp"

namespace cairn {
namespace {

using Time = Budget::Clock::time_point;

double ms_since(Time begin) {
  return std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
}

PlanResult refused(const Refusal& refusal) {
  PlanResult result;
  result.outcome = refusal.outcome;
  result.reason = refusal.reason;
  return result;
}

PlanResult stopped(PlanOutcome outcome) {
  if (outcome == PlanOutcome::cancelled) return refused({outcome, "planning was cancelled"});
  return refused({outcome, "the budget was used up before a way was found"});
}

// One request on its way to an answer.
class Query {
 public:
  Query(const HybridConfig& config, UnknownPolicy unknown, const SpaceCache& spaces, const Planner& route,
        const Planner& graph, const PlanRequest& request, const WorldView& world, const Budget& budget)
      : config_(config),
        spaces_(spaces),
        route_(route),
        graph_(graph),
        request_(request),
        world_(world),
        budget_(budget) {
    ends_.ground.unknown = unknown;
    ends_.radius_m = request.radius_m;
    ends_.start_tolerance_m = config.start_tolerance_m;
    legs_ = {request.radius_m, config.detour_ratio, request.seed};
  }

  PlanResult answer() {
    if (budget_.exhausted() || budget_.iterations <= 0) return stopped(stop_outcome());
    if (world_.grid.bounds().empty()) return graph_.plan(request_, world_, budget_);
    if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused(*refusal);
    const auto start = start_of(request_.from, world_, ends_, spaces_);
    if (const auto* refusal = std::get_if<Refusal>(&start)) return refused(*refusal);
    PlanResult result = answer_from(std::get<StartPlace>(start));
    result.settled = settled_;
    result.alternatives = alternatives_;
    result.explanation = explanation_;
    result.blocked_routes.assign(blocked_.begin(), blocked_.end());
    for (const RouteId id : blocked_) result.reason += "; " + text_of_route(id) + " is blocked";
    result.time_ms.graph_ms = graph_ms_;
    result.time_ms.route_ms = route_ms_;
    return result;
  }

 private:
  PlanResult answer_from(const StartPlace& start) {
    const TravelField travel = start.space->travel_at_most(start.leave_from, ends_.radius_m);
    const auto goals_or_refusal = goals_of(request_.to, world_, ends_, start, [&](const Point& goal) {
      return travel.reaches(start.space->field().cell_at(goal));
    });
    if (const auto* refusal = std::get_if<Refusal>(&goals_or_refusal)) return refused(*refusal);
    const auto& goals = std::get<std::vector<GoalPlace>>(goals_or_refusal);
    const GoalPlace& nearest = nearest_of(goals, *start.space, travel);
    const double direct_m = travel.cost_m(start.space->field().cell_at(nearest.pose.position()));
    if (start.landmark == nearest.landmark && start.landmark != 0) return stay(start, nearest);

    // The robot's world as it is planned in: with the ground under the robot known, and the robot no
    // longer where a leg begins.
    const WorldView planned_world{start.grid_of(world_), world_.graph, world_.robot,          world_.pose,
                                  world_.time_s,         nullptr,      world_.held_back_ratio};
    const SymbolicQuery query{
        request_, world_, start, goals, travel, ends_.radius_m + kLeastRadius_m, config_.detour_ratio};
    for (;;) {
      const SymbolicAnswer symbolic = search_graph(query);
      if (symbolic.stopped) return stopped(*symbolic.stopped);
      if (!symbolic.path) break;
      // Who asks for other than short ways takes longer ones into the bargain.
      if (request_.cost == CostKind::length && symbolic.path->cost_m > config_.detour_ratio * direct_m) {
        why_direct_ = "directly: over landmarks it is " + metres_text(symbolic.path->cost_m) + ", the direct way " +
                      metres_text(direct_m);
        break;
      }
      const GoalPlace& goal = goals[symbolic.path->goal];
      const Walk walk = walk_along(planned_world, start, *symbolic.path, goal);
      if (walk.stopped) return stopped(*walk.stopped);
      if (walk.mile_failed) break;
      if (!walk.blocked) return over_landmarks(start, goal, *symbolic.path, walk);
      blocked_.insert(*walk.blocked);
    }
    return direct(planned_world, start, goals, travel);
  }

  static const GoalPlace& nearest_of(const std::vector<GoalPlace>& goals, const DiscSpace& space,
                                     const TravelField& travel) {
    const auto cost_m = [&](const GoalPlace& g) { return travel.cost_m(space.field().cell_at(g.pose.position())); };
    return *std::min_element(goals.begin(), goals.end(),
                             [&](const GoalPlace& a, const GoalPlace& b) { return cost_m(a) < cost_m(b); });
  }

  SymbolicAnswer search_graph(const SymbolicQuery& query) {
    const Time begin = Budget::Clock::now();
    SymbolicAnswer answer = symbolic_path(query, blocked_, graph_, budget_);
    graph_ms_ += ms_since(begin);
    settled_ += answer.settled;
    alternatives_ = answer.alternatives;
    explanation_ = answer.explanation;
    return answer;
  }

  Walk walk_along(const WorldView& planned_world, const StartPlace& start, const SymbolicPath& path,
                  const GoalPlace& goal) {
    const Time begin = Budget::Clock::now();
    Walk walk = Walker(planned_world, *start.space, legs_, route_, budget_).walk(start.leave_from, path, goal.pose);
    route_ms_ += ms_since(begin);
    return walk;
  }

  PlanResult stay(const StartPlace& start, const GoalPlace& goal) const {
    PlanResult result = finished(start, goal, {start.leave_from});
    result.landmarks = {goal.landmark};
    result.reason = "start and goal are the same landmark";
    return result;
  }

  PlanResult over_landmarks(const StartPlace& start, const GoalPlace& goal, const SymbolicPath& path,
                            const Walk& walk) const {
    PlanResult result = finished(start, goal, walk.route);
    result.cost_m = walk.cost_m;
    result.landmarks = path.landmarks;
    result.routes = path.routes;
    result.reason = "over " + std::to_string(path.landmarks.size()) + " landmarks, by " +
                    std::to_string(walk.stored_legs) + " stored and " + std::to_string(walk.planned_legs) +
                    " newly planned legs" + goal.note + escape_text(start);
    return result;
  }

  // Without landmarks in between: goals in the order of their travel, until one is reached.
  PlanResult direct(const WorldView& planned_world, const StartPlace& start, std::vector<GoalPlace> goals,
                    const TravelField& travel) {
    const auto cost_m = [&](const GoalPlace& g) {
      return travel.cost_m(start.space->field().cell_at(g.pose.position()));
    };
    std::stable_sort(goals.begin(), goals.end(),
                     [&](const GoalPlace& a, const GoalPlace& b) { return cost_m(a) < cost_m(b); });
    PlanResult first;
    for (const GoalPlace& goal : goals) {
      PlanResult result = direct_to(planned_world, start, goal);
      if (result.outcome == PlanOutcome::solved || budget_.exhausted()) return result;
      if (first.reason.empty()) first = std::move(result);
    }
    return first;
  }

  PlanResult direct_to(const WorldView& planned_world, const StartPlace& start, const GoalPlace& goal) {
    PlanRequest request;
    request.from.pose = Pose2{start.leave_from.x(), start.leave_from.y(), start.pose.theta_rad};
    request.to.pose = goal.pose;
    request.to.heading_matters = goal.heading_rad.has_value();
    request.radius_m = request_.radius_m;
    request.seed = request_.seed;
    const Time begin = Budget::Clock::now();
    PlanResult planned = route_.plan(request, planned_world, budget_);
    route_ms_ += ms_since(begin);
    std::vector<Point> route;
    for (const Pose2& pose : planned.path) route.push_back(pose.position());
    if (planned.outcome == PlanOutcome::solved &&
        !route_is_free(start.grid_of(world_), ends_.ground, route, ends_.radius_m))
      return refused({PlanOutcome::no_route, "the route planner's path touches something and was refused"});
    if (planned.outcome != PlanOutcome::solved) {
      if (start.escape && !planned.path.empty()) planned.path.insert(planned.path.begin(), start.pose);
      return planned;
    }
    PlanResult result = finished(start, goal, route);
    for (const LandmarkId id : {start.landmark, goal.landmark})
      if (id != 0 && (result.landmarks.empty() || result.landmarks.back() != id)) result.landmarks.push_back(id);
    result.reason =
        (why_direct_.empty() ? "directly" : why_direct_) + "; " + planned.reason + goal.note + escape_text(start);
    return result;
  }

  // Joins, shortens and re-checks; `route` begins where the start is left.
  PlanResult finished(const StartPlace& start, const GoalPlace& goal, std::vector<Point> route) const {
    if (start.escape) route.insert(route.begin(), start.pose.position());
    if (config_.shortcut)
      route = straightened(*start.space, route, ends_.radius_m + kLeastRadius_m, start.escape ? 2 : 1);
    route.erase(std::unique(route.begin(), route.end()), route.end());
    if (!route_is_free(start.grid_of(world_), ends_.ground, route, ends_.radius_m, start.escape))
      throw std::logic_error("hybrid: the re-check refused a path of " + std::to_string(route.size()) +
                             " points from " + text_of(route.front()) + " to " + text_of(route.back()) + ", radius " +
                             std::to_string(ends_.radius_m));
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    result.length_m = length_of(route);
    result.cost_m = result.length_m;
    result.clearance_m = clearance_along(*start.space, route, ends_.radius_m);
    result.path = poses_along(route, start.pose.theta_rad, goal.heading_rad);
    return result;
  }

  static std::string escape_text(const StartPlace& start) {
    if (!start.escape) return {};
    return "; the start is too near to something and is left towards " + text_of(start.escape->to) +
           " with less clearance than the robot's radius asks for";
  }

  std::string text_of_route(RouteId id) const {
    const Route& route = *world_.graph.find_route(id);
    return "route R" + std::to_string(id) + " (" + label_of(*world_.graph.find(route.from)) + " to " +
           label_of(*world_.graph.find(route.to)) + ")";
  }

  PlanOutcome stop_outcome() const { return budget_.cancelled() ? PlanOutcome::cancelled : PlanOutcome::out_of_budget; }

  const HybridConfig& config_;
  const SpaceCache& spaces_;
  const Planner& route_;
  const Planner& graph_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  EndRules ends_;
  LegRules legs_;
  std::set<RouteId> blocked_;
  std::string why_direct_;
  std::int64_t settled_ = 0;
  std::vector<PlanAlternative> alternatives_;
  std::optional<PlanExplanation> explanation_;
  double graph_ms_ = 0.0;
  double route_ms_ = 0.0;
};

}  // namespace

UnknownPolicy unknown_policy_of(const PluginChoice& route) {
  const ConfigValue* unknown = route.config.find("unknown");
  return unknown != nullptr && unknown->scalar == "allow" ? UnknownPolicy::allow : UnknownPolicy::avoid;
}

HybridPlanner::HybridPlanner(HybridConfig config, std::shared_ptr<const Planner> route,
                             std::shared_ptr<const Planner> graph)
    : config_(std::move(config)),
      unknown_(unknown_policy_of(config_.route)),
      route_(std::move(route)),
      graph_(std::move(graph)) {
  if (!route_ || !graph_) throw std::invalid_argument("hybrid: needs a route planner and a graph planner");
}

PlanResult HybridPlanner::plan(const PlanRequest& request, const WorldView& world, const Budget& budget) const {
  if (!(request.radius_m >= 0.0 && std::isfinite(request.radius_m)))
    throw std::invalid_argument("hybrid: radius_m must be finite and not negative, got " +
                                std::to_string(request.radius_m));
  const Time begin = Budget::Clock::now();
  PlanResult result = Query(config_, unknown_, spaces_, *route_, *graph_, request, world, budget).answer();
  result.time_ms.total_ms = ms_since(begin);
  return result;
}

}  // namespace cairn
