#include "framework/mission/loop/planning.hpp"

#include "framework/modules/plausibility.hpp"
#include "framework/planning/margins.hpp"

namespace cairn {
namespace {

PlanResult plausible(const Staged<Planner>& planner, PlanResult plan) {
  if (const std::string fault = fault_of(plan); !fault.empty()) throw planner.fault(fault);
  return plan;
}

constexpr std::size_t kJoiningSeed = 1;  // 0: the planner itself
static_assert(kMaxMarginDetour <= LandmarkConnector::kMaxMarginDetour);

ClusterId of_level_with(const ClusterTree& tree, int level, LandmarkId landmark) {
  const auto lowest = tree.cluster_of.find(landmark);
  ClusterId id = lowest == tree.cluster_of.end() ? 0 : lowest->second;
  while (id != 0 && tree.clusters.at(id).level < level) id = tree.clusters.at(id).parent;
  return id;
}

}  // namespace

ClusterTree clusters_to_begin_with(const ClustersConfig& config, const SavedMap* resume) {
  if (resume == nullptr) return {};
  const ClusterSizes sizes = config.sizes();
  if (cluster_sizes_of(resume->properties) == sizes) return resume->clusters;
  ClusterTree made =
      cluster_landmarks(resume->graph, {}, {sizes, passages_in(resume->grid, resume->graph, sizes.narrow_below_m)});
  for (const auto& [id, old] : resume->clusters.clusters) {
    const ClusterId heir = old.name.empty() ? 0 : of_level_with(made, old.level, old.anchor);
    if (heir != 0 && made.clusters.at(heir).name.empty()) made.clusters.at(heir).name = old.name;
  }
  return made;
}

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
  if (world.pose.trust != PoseTrust::lost) world.hierarchies = &hierarchies_;
  return plausible(modules_.planner,
                   modules_.planner.call([&](Planner& planner) { return planner.plan(request, world, budget_); }));
}

void Planning::connect(LandmarkTracker& tracker, WorldView world) {
  if (!modules_.routes || tracker.graph().landmarks().empty()) return;
  monitor_.stand();
  world.hierarchies = nullptr;  // the graph changes meanwhile
  const PlanCall ask = [&](const PlanRequest& request) {
    return plausible(modules_.routes,
                     modules_.routes.call([&](Planner& planner) { return planner.plan(request, world, budget_); }));
  };
  // As questions are planned afterwards, which else would find the routes too narrow.
  const std::vector<double> margins_m = usual_margins_m(mission_.robot, world.grid);
  const auto plan = [&](const PlanRequest& request) { return plan_with_margins(ask, request, margins_m); };
  tracker.connect(world, plan, module_seed(mission_.config.seed, PluginKind::planner, kJoiningSeed));
  static_cast<void>(clusters(world.grid));
}

ClusterTree Planning::clusters(const OccupancyGrid& grid) {
  grid_ = &grid;
  hierarchies_.update();
  return hierarchies_.tree();
}

}  // namespace cairn
