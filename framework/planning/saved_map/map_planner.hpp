// A saved map with everything that one planner needs to answer questions about it.
//
// Questions asked one after another are answered without reading a large grid whole: by a planner that asks for the
// cells it needs (Planner::requires_cells), or, one question alone, on the part of the grid that it needs, where that
// gives an answer that is as good as one on the whole map (map_part.hpp).
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "framework/contracts/plan_question.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/planning/plan_task.hpp"
#include "framework/planning/saved_map/map_cells.hpp"
#include "framework/planning/saved_map/map_planner_options.hpp"
#include "maps/hierarchy/hierarchies.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// The robot that the options and the map say: of the robot file, or of the saved radius; radius_m makes a disc of that
// radius of it. Throws ConfigError, StoreError.
[[nodiscard]] RobotModel robot_of(const MapPlannerOptions& options, const SavedMap& map);

class MapPlanner {
 public:
  // Loads options.map. The library must outlive it. Throws what loading the map and the modules throws.
  MapPlanner(const MapPlannerOptions& options, PlannerUse use, const ModuleLibrary& library);
  // Of a map in memory, which nobody changes meanwhile, asked by several threads; options.map is its name in errors.
  MapPlanner(MapPlannerOptions options, std::shared_ptr<SavedMap> map, const ModuleLibrary& library);

  // A text that names nothing on any map ends a single question with a MalformedPlace; among many it is answered, like
  // a name that this map does not know, with `unknown_place`. Thread-safe when asked so (PlannerUse).
  [[nodiscard]] PlanResult answer(const PlanQuestion& question) const;
  // As the hierarchy has them.
  [[nodiscard]] const ClusterTree& clusters() const;
  // Its grid may not be read yet where no question has needed it.
  [[nodiscard]] const SavedMap& map() const { return *map_; }
  [[nodiscard]] const OccupancyGrid& whole_grid() const;
  [[nodiscard]] double radius_m() const { return robot_.radius_m; }
  [[nodiscard]] const RobotModel& robot() const { return robot_; }

 private:
  MapPlanner(MapPlannerOptions options, bool many, std::optional<MapFile> file, std::shared_ptr<SavedMap> map,
             const ModuleLibrary& library);
  [[nodiscard]] ClusterRules cluster_rules() const;
  [[nodiscard]] WorldView world_on(const OccupancyGrid& grid, std::uint64_t version) const;
  void prepare(const OccupancyGrid& grid, std::uint64_t version) const;
  [[nodiscard]] PlanResult plan_on(const OccupancyGrid& grid, std::uint64_t version, const PlanRequest& request,
                                   const Budget& budget) const;
  // None: no answer that is surely as good as one on the whole map.
  [[nodiscard]] std::optional<PlanResult> plan_on_part(const PlanRequest& request,
                                                       Budget::Clock::duration& spent) const;
  [[nodiscard]] PlanResult answer_asking_for_cells(const PlanTask& task) const;
  [[nodiscard]] Budget budget_after(Budget::Clock::duration spent) const;

  MapPlannerOptions options_;
  bool many_ = false;
  std::optional<MapFile> file_;  // of a large map for one thread: its grid is read as far as it is needed
  mutable std::once_flag grid_read_;
  std::shared_ptr<SavedMap> map_;  // its grid is read on in a const call, once
  std::optional<MapCells> cells_;  // of the file, for a planner that asks for them
  RobotModel robot_;
  std::vector<double> margins_m_;      // that are tried, the largest first
  std::optional<SpeedLaw> speed_law_;  // none: nobody knows which robot it is
  Hierarchies hierarchies_;
  mutable std::once_flag clusters_made_;
  mutable ClusterTree clusters_;
  std::shared_ptr<Planner> planner_;
};

}  // namespace cairn
