#include "framework/planning/saved_map/map_planner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "framework/files/robot_file.hpp"
#include "framework/modules/fence.hpp"
#include "framework/modules/plausibility.hpp"
#include "framework/planning/clusters_config.hpp"
#include "framework/planning/margins.hpp"
#include "framework/planning/place.hpp"
#include "framework/planning/saved_map/map_part.hpp"
#include "framework/planning/saved_map/saved_radius.hpp"
#include "framework/planning/tour.hpp"

namespace cairn {
namespace {

constexpr std::uint64_t kLoadedGrid = 1;  // its planner sees this grid as it was loaded, and parts of it as the next
constexpr std::int64_t kLarge_cells = 1'000'000;  // smaller grids are not worth taking apart
constexpr double kLikelyDetour_ratio = 1.4;       // of a path against the straight one, for the first part tried
constexpr double kAround_m = 5.0;                 // of a part, beyond what paths may pass: what stands there counts too
constexpr int kParts = 3;                         // that are tried

bool is_large(const CellBox& cells) {
  return std::int64_t{cells.width()} * cells.height() >= kLarge_cells;
}

// For one question at a time, which a part of the grid may answer.
std::optional<MapFile> opened_in_part(const std::filesystem::path& map, PlannerUse use) {
  if (use == PlannerUse::many_at_once || use == PlannerUse::one_question_whole_grid) return std::nullopt;
  std::optional<MapFile> file(map);
  return is_large(file->lattice().bounds()) ? std::move(file) : std::nullopt;
}

std::shared_ptr<SavedMap> map_of(const std::optional<MapFile>& file, const std::filesystem::path& name) {
  return std::make_shared<SavedMap>(file ? file->without_cells() : load_map(name));
}

RouteCostRules rules_of(const RobotModel& robot, const SavedMap& map) {
  return {robot.max_v_mps, robot.max_w_radps, robot.radius_m, &map.grid};
}

PluginChoice choice_of(const MapPlannerOptions& options) {
  PluginChoice choice{options.planner, {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place.file = "--planner";
  for (const std::string& assignment : options.settings) apply_override(choice.config, assignment);
  return choice;
}

// Clusters that the map does not hold are made only for a question that may be about them.
bool names_other_than_landmarks(const PlanQuestion& question, const LandmarkGraph& graph) {
  const auto is_other = [&](const std::string& name) {
    return !reads_as_place(name) && graph.find_by_name(name) == nullptr;
  };
  return is_other(question.from) || is_other(question.to) || std::ranges::any_of(question.via, is_other);
}

// As the robot of the mission that saved the map, or of a file.
bool is_robot_known(const MapPlannerOptions& options, const SavedMap& map) {
  return !options.robot.empty() || map.properties.contains(kRobotRadiusProperty);
}

// A radius or a margin that was given is meant as it is.
std::vector<double> margins_of(const MapPlannerOptions& options, const RobotModel& robot, const OccupancyGrid& grid) {
  if (options.margin_m) return {*options.margin_m};
  const bool sets_margin = std::ranges::any_of(
      options.settings, [](const std::string& text) { return text.find("margin_m=") != std::string::npos; });
  if (options.radius_m || sets_margin) return {0.0};
  return usual_margins_m(robot, grid);
}

PlanResult unknown_place(const PlaceError& error) {
  PlanResult unknown;
  unknown.outcome = PlanOutcome::unknown_place;
  unknown.reason = error.what();
  return unknown;
}

}  // namespace

RobotModel robot_of(const MapPlannerOptions& options, const SavedMap& map) {
  RobotModel robot;
  if (!options.robot.empty())
    robot = load_robot(options.robot);
  else if (!options.radius_m)
    robot.radius_m = saved_radius_m(map, options.map);
  if (options.radius_m) {
    robot.radius_m = *options.radius_m;
    robot.polygon_m.clear();
  }
  return robot;
}

MapPlanner::MapPlanner(MapPlannerOptions options, bool many, std::optional<MapFile> file, std::shared_ptr<SavedMap> map,
                       const ModuleLibrary& library)
    : options_(std::move(options)),
      many_(many),
      file_(std::move(file)),
      map_(map ? std::move(map) : map_of(file_, options_.map)),
      robot_(robot_of(options_, *map_)),
      margins_m_(margins_of(options_, robot_, map_->grid)),
      speed_law_(is_robot_known(options_, *map_) ? std::optional(SpeedLaw{}) : std::nullopt),
      hierarchies_(map_->graph, map_->clusters, rules_of(robot_, *map_), cluster_rules()) {
  const PluginChoice choice = choice_of(options_);
  ModuleContext context{robot_};
  context.seed = static_cast<std::uint64_t>(options_.seed);
  context.modules = &library;
  if (many_) static_cast<void>(hierarchies_.by(CostKind::length));  // not in the time of the first answer
  planner_ = fenced_making(choice.name, [&] { return library.make<Planner>(choice, context); });
  if (file_ && planner_->requires_cells() && !map_->graph.routes().empty())
    cells_.emplace(*file_, map_->grid);
  else if (many_)
    (void)whole_grid();
  if (many_) prepare(map_->grid, kLoadedGrid);  // neither is what the planner makes of the grid
}

MapPlanner::MapPlanner(const MapPlannerOptions& options, PlannerUse use, const ModuleLibrary& library)
    : MapPlanner(options, use == PlannerUse::many_in_turn || use == PlannerUse::many_at_once,
                 opened_in_part(options.map, use), nullptr, library) {}

MapPlanner::MapPlanner(MapPlannerOptions options, std::shared_ptr<SavedMap> map, const ModuleLibrary& library)
    : MapPlanner(std::move(options), true, std::nullopt, std::move(map), library) {}

WorldView MapPlanner::world_on(const OccupancyGrid& grid, std::uint64_t version) const {
  WorldView world{grid, map_->graph, robot_, {}};
  world.grid_version = version;
  world.speed_law = speed_law_;
  return world;
}

void MapPlanner::prepare(const OccupancyGrid& grid, std::uint64_t version) const {
  const WorldView world = world_on(grid, version);
  fenced("planner", options_.planner, [&] {
    planner_->prepare(world, robot_.radius_m + margins_m_.front());
    return 0;
  });
}

PlanResult MapPlanner::plan_on(const OccupancyGrid& grid, std::uint64_t version, const PlanRequest& request,
                               const Budget& budget) const {
  // Of a large graph or grid one answer is not worth making the hierarchy for.
  const bool is_small = !cells_ && map_->graph.landmarks().size() < cluster_sizes_of(map_->properties).large_from;
  const bool on_hierarchy = many_ || request.explain || is_small;
  WorldView world = world_on(grid, version);
  if (on_hierarchy) world.hierarchies = &hierarchies_;
  if (cells_) world.cells = &*cells_;
  PlanResult plan = fenced("planner", options_.planner, [&] { return planner_->plan(request, world, budget); });
  if (const std::string fault = fault_of(plan); !fault.empty()) throw ModuleFault("planner", options_.planner, fault);
  return plan;
}

// What is made of the map meanwhile does not count, what was tried before does.
Budget MapPlanner::budget_after(Budget::Clock::duration spent) const {
  Budget budget;
  if (options_.budget_ms)
    budget.deadline = Budget::Clock::now() + std::chrono::microseconds(std::llround(*options_.budget_ms * 1e3)) - spent;
  return budget;
}

std::optional<PlanResult> MapPlanner::plan_on_part(const PlanRequest& request, Budget::Clock::duration& spent) const {
  const CellBox whole = map_->grid.bounds();
  const auto ends = ends_of(request, map_->graph);
  const bool counts_lengths = options_.settings.empty() && request.cost == CostKind::length;
  const bool asks_more = request.alternatives > 0 || request.explain || !request.avoid.empty();
  if (!file_ || !ends || !counts_lengths || asks_more || robot_.radius_m > kAround_m / 2 ||
      !costs_are_lengths(map_->graph))
    return std::nullopt;
  double length_m = kLikelyDetour_ratio * (ends->to - ends->from).norm() + kAround_m;
  for (std::uint64_t version = kLoadedGrid + 1; version <= kLoadedGrid + kParts; ++version) {
    const CellBox box = part_for(*ends, length_m, kAround_m, map_->grid, whole);
    if (box == whole) return std::nullopt;
    const OccupancyGrid part = file_->grid_within(box);
    if (request.from.pose || request.to.pose) prepare(part, version);  // over landmarks, most of it is not needed
    const Budget::Clock::time_point begin = Budget::Clock::now();
    PlanResult result = plan_on(part, version, request, budget_after(spent));
    spent += Budget::Clock::now() - begin;
    // Nor is it known on the part what stands further from the path than its rim.
    const bool is_clear_of_all = result.clearance_m + robot_.radius_m >= kAround_m / 2;
    if (result.outcome != PlanOutcome::solved || is_clear_of_all) return std::nullopt;
    length_m = std::max(result.cost_m, result.length_m);
    if (length_m <= min_outside_m({result.path.front().position(), result.path.back().position()}, box, kAround_m / 2,
                                  map_->grid, whole))
      return result;
  }
  return std::nullopt;
}

PlanResult MapPlanner::answer(const PlanQuestion& question) const {
  PlanTask task;
  try {
    const bool makes_clusters = !question.avoid.empty() || (map_->clusters.cluster_of.empty() &&
                                                            names_other_than_landmarks(question, map_->graph));
    task = task_of(question, map_->graph, makes_clusters ? clusters() : map_->clusters);
  } catch (const MalformedPlace& error) {
    if (!many_) throw;
    return unknown_place(error);
  } catch (const PlaceError& error) {
    return unknown_place(error);
  }
  task.request.radius_m = robot_.radius_m;
  task.request.seed = static_cast<std::uint64_t>(options_.seed);
  Budget::Clock::duration spent{0};
  if (cells_) return answer_asking_for_cells(task);
  std::optional<Budget> budget;  // of the whole grid
  const auto plan = [&](const PlanRequest& request) {
    if (!many_ && task.via.empty() && !budget)
      if (auto result = plan_on_part(request, spent)) return *std::move(result);
    const OccupancyGrid& grid = whole_grid();
    if (!many_) prepare(grid, kLoadedGrid);
    if (!budget) budget = budget_after(spent);
    return plan_on(grid, kLoadedGrid, request, *budget);
  };
  return plan_tour([&](const PlanRequest& request) { return plan_with_margins(plan, request, margins_m_); },
                   task.request, task.via);
}

// Asked only for a map without clusters.
ClusterRules MapPlanner::cluster_rules() const {
  const ClusterSizes sizes = cluster_sizes_of(map_->properties);
  return {sizes, [this, max_m = sizes.narrow_below_m](const Route& route) {
            return passages_in(whole_grid(), map_->graph, max_m)(route);
          }};
}

PlanResult MapPlanner::answer_asking_for_cells(const PlanTask& task) const {
  // Other costs of routes are made of what stands beside them, wherever they lie.
  if (task.request.cost != CostKind::length || task.request.explain) cells_->require(map_->grid.bounds());
  const Budget budget = budget_after({});
  const auto plan = [&](const PlanRequest& request) { return plan_on(map_->grid, kLoadedGrid, request, budget); };
  return plan_tour([&](const PlanRequest& request) { return plan_with_margins(plan, request, margins_m_); },
                   task.request, task.via);
}

const OccupancyGrid& MapPlanner::whole_grid() const {
  std::call_once(grid_read_, [&] {
    if (file_) map_->grid = file_->grid_within(map_->grid.bounds());
  });
  return map_->grid;
}

const ClusterTree& MapPlanner::clusters() const {
  std::call_once(clusters_made_, [&] { clusters_ = hierarchies_.tree(); });
  return clusters_;
}

}  // namespace cairn
