#include "planners/hybrid/whole_query.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "planners/common/any_angle/nearest_goals.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/avoided.hpp"
#include "planners/hybrid/detour.hpp"
#include "planners/hybrid/open_routes.hpp"
#include "planners/hybrid/query_record.hpp"
#include "planners/hybrid/sketch.hpp"
#include "planners/hybrid/symbolic_path.hpp"

namespace cairn {
namespace {

using Time = Budget::Clock::time_point;

class WholeQuery {
 public:
  WholeQuery(const HybridTools& tools, const EndRules& ends, const LegRules& legs, const AnswerRules& answers,
             const PlanRequest& request, const WorldView& world, const Budget& budget)
      : tools_(tools), ends_(ends), legs_(legs), answers_(answers), request_(request), world_(world), budget_(budget) {}

  PlanResult answer() {
    const auto usual = start_of(request_.from, world_, ends_, tools_.usual.spaces);
    if (const auto* refusal = std::get_if<Refusal>(&usual)) return refused<PlanResult>(*refusal);
    const auto& start = std::get<StartPlace>(usual);
    if (!request_.avoid.empty()) avoided_grid_ = with_avoided_blocked(world_, request_, *start.space, legs_.disc_m);
    PlanResult result = avoided_grid_ ? answer_avoiding() : answer_from(start, world_);
    report_blocked_of(start, result);
    record_.put_into(result);
    return result;
  }

 private:
  // In the world with obstacles where the robot is not to go.
  PlanResult answer_avoiding() {
    const WorldView world = with_grid(*avoided_grid_, world_);
    const auto start = start_of(request_.from, world, ends_, tools_.avoiding.spaces);
    PlanResult result = std::holds_alternative<Refusal>(start) ? refused<PlanResult>(std::get<Refusal>(start))
                                                               : answer_from(std::get<StartPlace>(start), world);
    if (result.outcome != PlanOutcome::solved) result.reason += kAvoidedCount;
    return result;
  }

  // A route that only what is avoided blocks is not blocked today.
  void report_blocked_of(const StartPlace& start, PlanResult& result) {
    if (!avoided_grid_) return report_blocked(record_.blocked, world_.graph, result);
    const WorldView planned = planned_world(start, world_);
    const WholeGround ground = ground_of(start, planned);
    for (const RouteId id : record_.blocked) {
      if (Walker(ground, legs_, budget_).walk_alone(*world_.graph.find_route(id)).blocked)
        report_blocked({id}, world_.graph, result);
      else
        result.reason += "; " + text_of_route(id, world_.graph) + " passes an avoided landmark";
    }
  }

  // The robot's world as it is planned in: with the ground under the robot known, and the robot no
  // longer where a leg begins.
  static WorldView planned_world(const StartPlace& start, const WorldView& world) {
    WorldView planned = with_grid(start.grid_of(world), world);
    planned.observation = nullptr;
    planned.hierarchies = nullptr;
    return planned;
  }
  WholeGround ground_of(const StartPlace& start, const WorldView& planned) const {
    return {planned, *start.space, legs_.disc_m, tools_.path_planner};
  }

  PlanResult answer_from(const StartPlace& start, const WorldView& world) {
    const HybridGround& ground = avoided_grid_ ? tools_.avoiding : tools_.usual;
    const auto routes = ground.routes.routes_of(start.space, legs_.disc_m);
    const auto goals_or_refusal = goals_of(
        request_.to, world, ends_, start, [&](const Point& goal) { return routes->may_reach(start.leave_from, goal); });
    if (const auto* refusal = std::get_if<Refusal>(&goals_or_refusal)) return refused<PlanResult>(*refusal);
    std::vector<GoalPlace> goals;
    for (RankedGoal& goal :
         nearest_first(std::get<std::vector<GoalPlace>>(goals_or_refusal), start.leave_from, *routes, budget_))
      goals.push_back(std::move(goal.place));
    const GoalPlace& nearest = goals.front();
    const WorldView planned = planned_world(start, world);
    const WholeGround whole = ground_of(start, planned);
    if (start.landmark == nearest.landmark && start.landmark != 0) return stay(whole, start, nearest);

    const SymbolicQuery query{request_, world_, start, goals, legs_.disc_m, tools_.config.detour_ratio};
    const SymbolicSearch search(query, *tools_.route_planner, budget_);
    // What only a graph with routes needs.
    const double direct_min_m = world_.graph.routes().empty()
                                    ? 0.0
                                    : routes->length_lower_bound_m(start.leave_from, nearest.pose.position(), budget_);
    const DetourLimits limits{tools_.config.detour_ratio, tools_.config.shortened_ratio, direct_min_m};
    std::optional<PlanResult> over = over_graph(search, whole, *routes, start, goals, limits);
    if (over && is_for_time()) over = unless_direct_is_faster(std::move(*over), whole, start, nearest);
    PlanResult result = over ? std::move(*over) : direct(whole, start, goals);
    if (result.outcome == PlanOutcome::solved && request_.alternatives > 0)
      record_.alternatives =
          open_alternatives(search, candidates_, result.routes, request_.alternatives,
                            OpenRoutes(world_.graph, Walker(whole, legs_, budget_), record_.blocked), budget_);
    return result;
  }

  // The path over landmarks; none when there is none or the direct one is preferred.
  std::optional<PlanResult> over_graph(const SymbolicSearch& search, const PlanningGround& whole,
                                       const DiscRoutes& routes, const StartPlace& start,
                                       const std::vector<GoalPlace>& goals, const DetourLimits& limits) {
    // A request for other than short paths accepts longer ones.
    const bool any_length = request_.cost != CostKind::length || !request_.avoid.empty() || !request_.closed.empty();
    for (;;) {
      const SymbolicAnswer symbolic = record_.find(search);
      candidates_ = symbolic.candidates;
      if (symbolic.stopped) return refused<PlanResult>(stopped(*symbolic.stopped));
      if (!symbolic.path) return std::nullopt;
      const Detour detour = any_length ? Detour::none : detour_of(*symbolic.path, limits);
      if (detour == Detour::too_long) return prefer_direct(costly_text(*symbolic.path, limits));
      const GoalPlace& goal = goals[symbolic.path->goal];
      AnswerRules answers = answers_;
      answers.from_both_ends = detour == Detour::shortened;
      if (detour == Detour::shortened) {
        const auto sketched_m = sketch(whole, routes, start, *symbolic.path, goal);
        if (sketched_m && !is_short_enough(*sketched_m, limits)) return prefer_direct(long_text(*sketched_m, limits));
      }
      const Walk walk = walk_along(whole, start, *symbolic.path, goal);
      if (walk.stopped) return refused<PlanResult>(stopped(*walk.stopped));
      if (walk.access_leg_failed) return std::nullopt;
      if (!walk.blocked) {
        PlanResult result = over_landmarks(answers, whole, budget_, start, goal, *symbolic.path, walk);
        const double shortened_m = result.length_m - escape_m(start);
        if (detour == Detour::shortened && !is_short_enough(shortened_m, limits))
          return prefer_direct(long_text(shortened_m, limits));
        return result;
      }
      record_.blocked.insert(*walk.blocked);
    }
  }

  // Speed limits hold on routes alone: where the graph has them, its paths are taken.
  [[nodiscard]] bool is_for_time() const {
    return request_.cost == CostKind::time && request_.avoid.empty() && request_.closed.empty() &&
           std::ranges::none_of(world_.graph.routes(),
                                [](const auto& r) { return r.second.speed_limit_mps.has_value(); });
  }

  // None: the direct path takes less time to drive.
  std::optional<PlanResult> unless_direct_is_faster(PlanResult over, const PlanningGround& whole,
                                                    const StartPlace& start, const GoalPlace& nearest) {
    if (over.outcome != PlanOutcome::solved || !over.driving_time_s) return over;
    const PlanResult straight = direct_to(whole, start, nearest);
    if (straight.outcome != PlanOutcome::solved || straight.driving_time_s >= over.driving_time_s) return over;
    why_direct_ = fmt::format("directly: over landmarks it takes {:.1f} s, the direct path {:.1f} s",
                              *over.driving_time_s, *straight.driving_time_s);
    return std::nullopt;
  }

  std::nullopt_t prefer_direct(std::string why) {
    why_direct_ = std::move(why);
    return std::nullopt;
  }

  std::optional<double> sketch(const PlanningGround& whole, const DiscRoutes& routes, const StartPlace& start,
                               const SymbolicPath& path, const GoalPlace& goal) {
    const Time begin = Budget::Clock::now();
    const auto length_m =
        sketched_length_m(whole, routes, legs_, answers_.shortcut, budget_, start.leave_from, path, goal.pose);
    record_.route_ms += QueryRecord::ms_since(begin);
    return length_m;
  }

  Walk walk_along(const PlanningGround& whole, const StartPlace& start, const SymbolicPath& path,
                  const GoalPlace& goal) {
    const Time begin = Budget::Clock::now();
    Walk walk = Walker(whole, legs_, budget_).walk(start.leave_from, path, goal.pose);
    record_.route_ms += QueryRecord::ms_since(begin);
    return walk;
  }

  PlanResult stay(const PlanningGround& whole, const StartPlace& start, const GoalPlace& goal) const {
    PlanResult result = joined(answers_, whole, budget_, start, goal, {{start.leave_from, 0}}, {});
    result.landmarks = {goal.landmark};
    result.reason = "start and goal are the same landmark";
    return result;
  }

  // Without landmarks in between: the goals in their order, until one is reached.
  PlanResult direct(const PlanningGround& whole, const StartPlace& start, const std::vector<GoalPlace>& goals) {
    PlanResult first;
    for (const GoalPlace& goal : goals) {
      PlanResult result = direct_to(whole, start, goal);
      if (result.outcome == PlanOutcome::solved || budget_.exhausted()) return result;
      if (first.reason.empty()) first = std::move(result);
    }
    return first;
  }

  PlanResult direct_to(const PlanningGround& whole, const StartPlace& start, const GoalPlace& goal) {
    const Time begin = Budget::Clock::now();
    PlanResult planned = plan_of(whole.path(direct_request(request_, start, goal), budget_));
    record_.route_ms += QueryRecord::ms_since(begin);
    if (planned.path.empty()) return planned;
    PlanResult result = as_planned(answers_, whole, start, goal, planned);
    if (!result.path.empty()) result.reason = (why_direct_.empty() ? "directly" : why_direct_) + "; " + result.reason;
    return result;
  }

  const HybridTools& tools_;
  const EndRules& ends_;
  const LegRules& legs_;
  const AnswerRules& answers_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  std::optional<OccupancyGrid> avoided_grid_;
  std::vector<RouteAlternative> candidates_;  // of the last search
  std::string why_direct_;
  QueryRecord record_;
};

}  // namespace

PlanResult answer_on_whole_grid(const HybridTools& tools, const EndRules& ends, const LegRules& legs,
                                const AnswerRules& answers, const PlanRequest& request, const WorldView& world,
                                const Budget& budget) {
  return WholeQuery(tools, ends, legs, answers, request, world, budget).answer();
}

}  // namespace cairn
