#include "planners/hybrid/stored_route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/hybrid/avoided.hpp"
#include "planners/hybrid/length_lower_bound.hpp"

namespace cairn {
namespace {

constexpr double kBeside_m = 3.0;  // of the grid on each side of the path; clearances are known up to there

bool may_be_asked(const PlanRequest& request, const WorldView& world) {
  const bool between_landmarks = !request.from.pose && request.from.landmarks.size() == 1 && !request.to.pose;
  const bool asks_more = request.cost != CostKind::length || !request.avoid.empty() || !request.closed.empty() ||
                         request.alternatives > 0 || request.explain;
  return between_landmarks && !asks_more && world.observation == nullptr && !world.graph.routes().empty();
}

class StoredRoute {
 public:
  StoredRoute(const HybridTools& tools, const LegRules& legs, const AnswerRules& answers, const PlanRequest& request,
              const WorldView& world, const Budget& budget)
      : tools_(tools), legs_(legs), answers_(answers), request_(request), world_(world), budget_(budget) {
    legs_.straight_clearance_m = 0.0;  // as they were driven: what joins them is short
  }

  std::optional<PlanResult> find() {
    if (!take_ends()) return std::nullopt;
    const SymbolicQuery query{request_, world_, start_, goals_, legs_.disc_m, legs_.detour_ratio};
    const Budget::Clock::time_point begin = Budget::Clock::now();
    const SymbolicAnswer symbolic = SymbolicSearch(query, *tools_.route_planner, budget_).find({});
    const auto graph_time = Budget::Clock::now() - begin;
    if (!symbolic.path || !is_preferred(symbolic.path->cost_m)) return std::nullopt;
    auto result = walked(*symbolic.path, goals_[symbolic.path->goal]);
    if (!result) return std::nullopt;
    result->settled = symbolic.settled;
    result->time_ms.graph_ms = std::chrono::duration<double, std::milli>(graph_time).count();
    result->time_ms.route_ms =
        std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin - graph_time).count();
    return result;
  }

 private:
  // A landmark's stored approach pose, where it is free.
  std::optional<Pose2> usual_approach(LandmarkId id) const {
    const Landmark* const landmark = world_.graph.find(id);
    if (landmark == nullptr || !landmark->access) return std::nullopt;
    const Point at = landmark->access->position();
    return sweep_is_free(world_.grid, answers_.ground, at, at, legs_.disc_m) ? landmark->access : std::nullopt;
  }

  bool take_ends() {
    start_.landmark = request_.from.landmarks.front();
    const auto start = usual_approach(start_.landmark);
    if (!start) return false;
    start_.pose = *start;
    start_.leave_from = start->position();
    for (const LandmarkId id : request_.to.landmarks) {
      const auto approach = usual_approach(id);
      if (!approach || id == start_.landmark) return false;
      goals_.push_back({*approach, std::nullopt, id, ""});
      straight_m_ = std::min(straight_m_, (approach->position() - start_.leave_from).norm());
    }
    return !goals_.empty();
  }

  // To any direct path, however short that may be.
  bool is_preferred(double cost_m) const {
    if (cost_m <= legs_.detour_ratio * straight_m_) return true;
    if (goals_.size() != 1) return false;
    const Point to = goals_.front().pose.position();
    return cost_m <= legs_.detour_ratio * length_lower_bound_m(world_.grid, answers_.ground, legs_.disc_m,
                                                               start_.leave_from, to, budget_);
  }

  CellBox box_along(const SymbolicPath& path, const GoalPlace& goal) const {
    std::vector<Point> points{start_.leave_from, goal.pose.position()};
    for (const RouteId id : path.routes)
      for (const Pose2& pose : world_.graph.find_route(id)->trajectory) points.push_back(pose.position());
    CellBox box;
    for (const Point& point : points) {
      const Cell cell = world_.grid.cell_at(point);
      box = united(box, {cell, cell + Cell{1, 1}});
    }
    return box.grown(static_cast<int>(std::ceil((kBeside_m + legs_.disc_m) / world_.grid.cell_m())));
  }

  std::optional<PlanResult> walked(const SymbolicPath& path, const GoalPlace& goal) {
    for (const RouteId id : path.routes)
      if (world_.graph.find_route(id)->trajectory.empty()) return std::nullopt;
    const OccupancyGrid grid = part_of(world_.grid, box_along(path, goal));
    start_.space = std::make_shared<const DiscSpace>(grid, answers_.ground);
    WorldView beside = with_grid(grid, world_);
    beside.hierarchies = nullptr;
    const Walk walk =
        Walker(beside, *start_.space, legs_, tools_.path_planner, budget_).walk(start_.leave_from, path, goal.pose);
    const bool all_stored = walk.planned_legs == 0 &&
                            std::none_of(walk.parts.begin(), walk.parts.end(),
                                         [](const auto& part) { return part.origin == PathSegment::Origin::planned; });
    if (!walk.complete() || !all_stored) return std::nullopt;
    PlanResult result = over_landmarks(answers_, grid, budget_, start_, goal, path, walk);
    return result.clearance_m < kBeside_m ? std::optional(std::move(result)) : std::nullopt;
  }

  const HybridTools& tools_;
  LegRules legs_;
  const AnswerRules& answers_;
  const PlanRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  StartPlace start_;
  std::vector<GoalPlace> goals_;
  double straight_m_ = std::numeric_limits<double>::infinity();  // to the nearest goal
};

}  // namespace

std::optional<PlanResult> stored_route(const HybridTools& tools, const LegRules& legs, const AnswerRules& answers,
                                       const PlanRequest& request, const WorldView& world, const Budget& budget) {
  if (!may_be_asked(request, world)) return std::nullopt;
  return StoredRoute(tools, legs, answers, request, world, budget).find();
}

}  // namespace cairn
