#include "planners/hybrid/hybrid_query.hpp"

#include <algorithm>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "framework/contracts/view/cell_source.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/answers.hpp"
#include "planners/hybrid/legs.hpp"
#include "planners/hybrid/segments.hpp"
#include "planners/hybrid/whole_query.hpp"
#include "planners/hybrid/windows/local_query.hpp"

namespace cairn {
namespace {

// Answers one request.
class Query {
 public:
  Query(const HybridTools& tools, const PlanRequest& request, const WorldView& world, const Budget& budget)
      : tools_(tools), request_(request), world_(world), budget_(budget) {
    ends_.ground.unknown = tools.traits.unknown;
    ends_.radius_m = request.radius_m + tools.traits.margin_m;
    ends_.start_tolerance_m = tools.config.start_tolerance_m;
    legs_ = {request.radius_m, disc_m(), tools.config.detour_ratio, request.seed, request.speed_mps};
    answers_ = {ends_.ground, request.radius_m, ends_.radius_m, tools.config.shortcut,
                driving_rules_of(world, request.radius_m, request.speed_mps)};
    if (answers_.driving && tools.traits.for_driving_time) {
      legs_.straight_clearance_m = std::max(0.0, answers_.driving->pace.open_from_m() - added_m());
      answers_.shortcut_clearance_m = legs_.straight_clearance_m;
    } else if (request.cost == CostKind::clearance) {
      answers_.shortcut = false;  // a corner that is cut is passed nearer
    }
  }

  PlanResult answer() {
    if (budget_.exhausted() || budget_.iterations <= 0) return refused<PlanResult>(stopped(stop_outcome(budget_)));
    if (world_.grid.bounds().empty()) return answer_of_graph();
    if (const auto refusal = refusal_of_place(request_.to, world_.graph, "goal")) return refused<PlanResult>(*refusal);
    if (is_answered_in_windows(world_)) {
      if (auto result = answer_in_windows()) return *std::move(result);
    }
    if (world_.cells != nullptr) world_.cells->require(world_.grid.bounds());
    PlanResult result = answer_on_whole_grid(tools_, ends_, legs_, answers_, request_, world_, budget_);
    result.reason += why_whole_;
    return result;
  }

 private:
  // None: the whole grid has to be searched.
  std::optional<PlanResult> answer_in_windows() {
    LocalAnswer local;
    if (request_.avoid.empty()) {
      local = answer_locally(tools_, ends_, legs_, answers_, WindowRules{}, request_, world_, budget_);
      why_whole_ = "; the whole grid was searched, since " + local.why_none;
    }
    return local.result;
  }

  PlanResult answer_of_graph() const {
    PlanResult result = LoneRoutePlanner(tools_.route_planner).plan(request_, world_, budget_);
    if (result.outcome == PlanOutcome::solved) result.segments = segments_of_graph(result, world_.graph);
    return result;
  }

  // That the planned disc keeps of the robot's clearance.
  double added_m() const { return ends_.radius_m - answers_.driving->radius_m; }

  // With a hair more than is re-checked, so that rounding makes no difference.
  double disc_m() const { return ends_.radius_m + kMinRadius_m; }

  const HybridTools& tools_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  EndRules ends_;
  LegRules legs_;
  AnswerRules answers_;
  std::string why_whole_;
};

}  // namespace

bool is_answered_in_windows(const WorldView& world) {
  constexpr std::int64_t kLarge_cells = 1'000'000;
  const CellBox box = world.grid.bounds();
  return std::int64_t{box.width()} * box.height() >= kLarge_cells && !world.graph.routes().empty();
}

PlanResult answer_over_landmarks(const HybridTools& tools, const PlanRequest& request, const WorldView& world,
                                 const Budget& budget) {
  return Query(tools, request, world, budget).answer();
}

}  // namespace cairn
