#include "planners/hybrid/windows/local_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/avoided.hpp"
#include "planners/hybrid/detour.hpp"
#include "planners/hybrid/open_routes.hpp"
#include "planners/hybrid/query_record.hpp"
#include "planners/hybrid/windows/local_ends.hpp"

namespace cairn {
namespace {

constexpr int kMaxAccessFailures = 8;

class LocalQuery {
 public:
  LocalQuery(const HybridTools& tools, const EndRules& ends, const LegRules& legs, const AnswerRules& answers,
             const WindowRules& windows, const PlanRequest& request, const WorldView& world, const Budget& budget)
      : tools_(tools),
        legs_(legs),
        answers_(answers),
        request_(request),
        world_(world),
        budget_(budget),
        windows_(windows),
        ground_(world, ends.ground, legs.disc_m, tools.path_planner, tools.windows, windows,
                tools.config.shortcut && legs.straight_clearance_m == 0.0),
        ends_(ground_, ends, windows, budget) {}

  LocalAnswer answer() {
    auto start = ends_.start(request_.from);
    if (const auto* refusal = std::get_if<Refusal>(&start)) return {refused<PlanResult>(*refusal), ""};
    start_ = std::get<StartPlace>(std::move(start));
    auto goals = ends_.goals(request_.to, start_);
    if (const auto* refusal = std::get_if<Refusal>(&goals)) return {refused<PlanResult>(*refusal), ""};
    goals_ = std::get<std::vector<GoalPlace>>(std::move(goals));
    for (const GoalPlace& goal : goals_)
      if (goal.landmark != 0 && goal.landmark == start_.landmark) return {stay(goal), ""};
    std::optional<PlanResult> result = found();
    if (!result) return {std::nullopt, why_none_};
    report_blocked(record_.blocked, world_.graph, *result);
    record_.put_into(*result);
    return {std::move(result), ""};
  }

 private:
  PlanResult stay(const GoalPlace& goal) const {
    PlanResult result = joined(answers_, ground_, budget_, start_, goal, {{start_.leave_from, 0}}, {});
    result.landmarks = {goal.landmark};
    result.reason = "start and goal are the same landmark";
    return result;
  }

  std::optional<PlanResult> found() {
    const std::optional<NearGoal> near = ends_.nearest(start_, goals_, windows_.near_m);
    SymbolicEnd from = ends_.joined(start_);
    SymbolicEnd to = ends_.joined(goals_);
    if (from.empty() || to.empty())
      why_none_ = std::string("no landmark with routes is reached near the ") + (from.empty() ? "start" : "goal");
    const SymbolicQuery query{request_, world_, start_, goals_, legs_.disc_m, 1.0};
    for (int failures = 0; failures <= kMaxAccessFailures && !from.empty() && !to.empty(); ++failures) {
      const SymbolicSearch search(query, *tools_.route_planner, budget_, from, to);
      std::optional<LandmarkId> unreached;
      auto result = over_graph(search, near, unreached);
      if (result) return result;
      if (!unreached) break;
      from.remove(*unreached);
      to.remove(*unreached);
      why_none_ = "the landmarks near an end cannot be reached from it";
    }
    // Also where both ends are joined to the same landmark.
    const double joined_m = 2.0 * (windows_.reach_blocks + 1) * windows_.block_m;
    const auto goal = near ? near : ends_.nearest(start_, goals_, std::max(joined_m, windows_.near_m));
    return goal ? directly(*goal, std::numeric_limits<double>::infinity(), "directly") : std::nullopt;
  }

  // Along landmarks, or directly where that is much shorter. None when neither is found; `unreached` is a landmark that
  // an end cannot be joined to after all.
  std::optional<PlanResult> over_graph(const SymbolicSearch& search, const std::optional<NearGoal>& near,
                                       std::optional<LandmarkId>& unreached) {
    const bool any_length = request_.cost != CostKind::length || !request_.closed.empty();
    for (;;) {
      const SymbolicAnswer symbolic = record_.find(search);
      if (symbolic.stopped) return refused<PlanResult>(stopped(*symbolic.stopped));
      if (!symbolic.path) {
        why_none_ = "no open path over landmarks joins the ends";
        return std::nullopt;
      }
      const double cost_m = symbolic.path->cost_m;
      if (near && !any_length && cost_m > legs_.detour_ratio * near->min_m)
        if (auto result = directly(*near, cost_m, costly_text(cost_m, legs_.detour_ratio, near->min_m))) return result;
      const GoalPlace& goal = goals_[symbolic.path->goal];
      const Budget::Clock::time_point begin = Budget::Clock::now();
      const Walk walk = Walker(ground_, legs_, budget_).walk(start_.leave_from, *symbolic.path, goal.pose);
      if (walk.stopped) return refused<PlanResult>(stopped(*walk.stopped));
      if (walk.access_leg_failed) {
        unreached = unreached_end(walk, *symbolic.path);
        return std::nullopt;
      }
      if (walk.blocked) {
        record_.blocked.insert(*walk.blocked);
        continue;
      }
      PlanResult result = over_landmarks(answers_, ground_, budget_, start_, goal, *symbolic.path, walk);
      record_.route_ms += QueryRecord::ms_since(begin);
      if (request_.alternatives > 0)
        record_.alternatives =
            open_alternatives(search, symbolic.candidates, result.routes, request_.alternatives,
                              OpenRoutes(world_.graph, Walker(ground_, legs_, budget_), record_.blocked), budget_);
      return result;
    }
  }

  // None: it is between landmarks that a leg failed.
  static std::optional<LandmarkId> unreached_end(const Walk& walk, const SymbolicPath& path) {
    const auto legs = static_cast<std::size_t>(walk.stored_legs) + static_cast<std::size_t>(walk.planned_legs);
    if (legs == 0) return path.landmarks.front();
    return legs == path.routes.size() ? std::optional(path.landmarks.back()) : std::nullopt;
  }

  // Where it is not longer than that.
  std::optional<PlanResult> directly(const NearGoal& near, double at_most_m, const std::string& why) {
    const GoalPlace& goal = goals_[near.index];
    const Budget::Clock::time_point begin = Budget::Clock::now();
    const PlanResult planned = plan_of(ground_.path(direct_request(request_, start_, goal), budget_));
    record_.route_ms += QueryRecord::ms_since(begin);
    if (budget_.exhausted()) return refused<PlanResult>(stopped(stop_outcome(budget_)));
    if (planned.outcome != PlanOutcome::solved || planned.length_m > at_most_m) return std::nullopt;
    PlanResult result = as_planned(answers_, ground_, start_, goal, planned);
    if (result.outcome != PlanOutcome::solved) return std::nullopt;
    result.reason = why + "; " + result.reason;
    return result;
  }

  const HybridTools& tools_;
  const LegRules& legs_;
  const AnswerRules& answers_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  const WindowRules& windows_;
  WindowedGround ground_;
  LocalEnds ends_;
  StartPlace start_;
  std::vector<GoalPlace> goals_;
  std::string why_none_;
  QueryRecord record_;
};

}  // namespace

LocalAnswer answer_locally(const HybridTools& tools, const EndRules& ends, const LegRules& legs,
                           const AnswerRules& answers, const WindowRules& windows, const PlanRequest& request,
                           const WorldView& world, const Budget& budget) {
  std::optional<OccupancyGrid> patched;
  if (request.from.pose && robot_stands_at(world, request.from.pose->position()))
    patched = with_ground_under(world.grid, ends.ground, request.from.pose->position(), legs.disc_m);
  if (!patched) return LocalQuery(tools, ends, legs, answers, windows, request, world, budget).answer();
  const WorldView known = with_grid(*patched, world);
  return LocalQuery(tools, ends, legs, answers, windows, request, known, budget).answer();
}

}  // namespace cairn
