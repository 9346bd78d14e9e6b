#include "framework/program/map_planner.hpp"

#include <chrono>
#include <cmath>

#include "framework/config/robot_file.hpp"
#include "framework/host/fence.hpp"
#include "framework/host/place.hpp"
#include "framework/host/tour.hpp"
#include "framework/program/saved_radius.hpp"

namespace cairn {
namespace {

constexpr std::uint64_t kLoadedGrid = 1;  // its planner sees this one grid, as it was loaded

RouteCostRules rules_of(const RobotModel& robot, const SavedMap& map) {
  return {robot.max_v_mps, robot.max_w_radps, robot.radius_m, &map.grid};
}

PluginChoice choice_of(const PlanCommand& command) {
  PluginChoice choice{command.planner, {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place.file = "--planner";
  for (const std::string& assignment : command.settings) apply_override(choice.config, assignment);
  return choice;
}

PlanResult unknown_place(const PlaceError& error) {
  PlanResult unknown;
  unknown.outcome = PlanOutcome::unknown_place;
  unknown.reason = error.what();
  return unknown;
}

}  // namespace

RobotModel robot_of(const PlanCommand& command, const SavedMap& map) {
  RobotModel robot;
  if (!command.robot.empty())
    robot = load_robot(command.robot);
  else if (!command.radius_m)
    robot.radius_m = saved_radius_m(map, command.map);
  if (command.radius_m) {
    robot.radius_m = *command.radius_m;
    robot.polygon_m.clear();
  }
  return robot;
}

MapPlanner::MapPlanner(const PlanCommand& command, const CommonOptions& common)
    : command_(command),
      many_(!command.queries.empty()),
      library_(plugin_folders(common.plugin_folders)),
      map_(load_map(command.map)),
      robot_(robot_of(command, map_)),
      hierarchies_(map_.graph, map_.clusters, rules_of(robot_, map_)) {
  const PluginChoice choice = choice_of(command);
  ModuleContext context{robot_};
  context.seed = static_cast<std::uint64_t>(command.seed);
  context.modules = &library_;
  if (many_) static_cast<void>(hierarchies_.by(CostKind::length));  // not in the time of the first answer
  planner_ = fenced_making(choice.name, [&] { return library_.make<Planner>(choice, context); });
  // Neither is what the planner makes of the grid.
  const WorldView world{map_.grid, map_.graph, robot_, {}, 0.0, nullptr, 0.0, nullptr, kLoadedGrid};
  fenced("planner", command.planner, [&] {
    planner_->prepare(world, robot_.radius_m);
    return 0;
  });
}

PlanResult MapPlanner::answer(const PlanQuery& query) const {
  PlanTask task;
  try {
    task = task_of(query.question, map_, query.question.avoid.empty() ? ClusterTree{} : clusters());
  } catch (const MalformedPlace& error) {
    if (!many_) throw;
    return unknown_place(error);
  } catch (const PlaceError& error) {
    return unknown_place(error);
  }
  task.request.radius_m = robot_.radius_m;
  task.request.seed = static_cast<std::uint64_t>(command_.seed);
  Budget budget;
  if (command_.budget_ms)
    budget.deadline = Budget::Clock::now() + std::chrono::microseconds(std::llround(*command_.budget_ms * 1e3));
  // One answer is not worth making the hierarchy for.
  const bool on_hierarchy = many_ || task.request.explain;
  const WorldView world{map_.grid,  map_.graph, robot_, {}, 0.0, nullptr, 0.0, on_hierarchy ? &hierarchies_ : nullptr,
                        kLoadedGrid};
  return plan_tour(
      [&](const PlanRequest& request) {
        return fenced("planner", command_.planner, [&] { return planner_->plan(request, world, budget); });
      },
      task.request, task.via);
}

const ClusterTree& MapPlanner::clusters() const {
  std::call_once(clusters_made_, [&] { clusters_ = hierarchies_.tree(); });
  return clusters_;
}

}  // namespace cairn
