#include "framework/mission/loop/planning.hpp"

namespace cairn {
namespace {

constexpr std::size_t kJoiningSeed = 1;  // 0: the planner itself

}  // namespace

Planning::Planning(const Mission& mission, const StagedModules& modules, const LandmarkGraph& graph,
                   ClusterTree clusters, CollisionMonitor& monitor, const Budget& budget)
    : mission_(mission),
      modules_(modules),
      monitor_(monitor),
      budget_(budget),
      hierarchies_(graph, std::move(clusters),
                   {mission.robot.max_v_mps, mission.robot.max_w_radps, mission.robot.radius_m},
                   {mission.config.clusters.sizes(), [this, &graph](const Route& route) -> std::optional<double> {
                      if (grid_ == nullptr) return std::nullopt;
                      return passages_in(*grid_, graph, mission_.config.clusters.narrow_below_m)(route);
                    }}) {}

PlanResult Planning::plan(const PlanRequest& request, WorldView world) {
  monitor_.stand();
  grid_ = &world.grid;
  hierarchies_.update();
  world.hierarchies = &hierarchies_;
  return modules_.planner.call([&](Planner& planner) { return planner.plan(request, world, budget_); });
}

void Planning::connect(LandmarkTracker& tracker, WorldView world) {
  if (!modules_.routes || tracker.graph().landmarks().empty()) return;
  monitor_.stand();
  world.hierarchies = nullptr;  // the graph changes meanwhile
  const auto plan = [&](const PlanRequest& request) {
    return modules_.routes.call([&](Planner& planner) { return planner.plan(request, world, budget_); });
  };
  tracker.connect(world, plan, module_seed(mission_.config.seed, PluginKind::planner, kJoiningSeed));
  static_cast<void>(clusters(world.grid));
}

ClusterTree Planning::clusters(const OccupancyGrid& grid) {
  grid_ = &grid;
  hierarchies_.update();
  return hierarchies_.tree();
}

}  // namespace cairn
