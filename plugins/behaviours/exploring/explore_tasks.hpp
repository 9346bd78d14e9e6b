// What exploring does next: an orbit round an object, a frontier, or an edge to look at, whichever is
// cheapest from here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/geometry/map_move.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "plugins/behaviours/exploring/settings.hpp"
#include "plugins/behaviours/lookouts/look_closer.hpp"

namespace cairn::behaviours {

struct TaskSettings {
  OrbitSettings orbit;     // look_closer_m 0: no orbits and no edges
  int far_edge_cells = 0;  // > 0: edges with free cells within so many count too
  double smallest_frontier_m = 0.3;
  double gain_m = 0.0;        // what e times the new area is worth; 0: the nearest frontier first
  double gain_range_m = 3.0;  // of the sensors, for the new area
  TaskWeights weights{};
  OpeningSettings openings{};
  CellBox window{};  // of the map that the space holds; empty: all of it
};

// An object that is circled again: only the trace from here on counts as having looked at it.
struct SecondLook {
  Point about{0.0, 0.0};
  std::size_t trace_from = 0;
};

// What exploring remembers between two choices.
struct ExploreMemory {
  std::vector<Pose2> trace;              // where the robot has been, a pose each 10 cm
  CellSet seen_edges;                    // or given up
  CellSet seen_frontiers;                // or given up
  std::vector<Point> given_up_lookouts;  // of orbits
  std::vector<SecondLook> second_looks;
  std::vector<Point> seen_openings;
  std::vector<TroubleSpot> troubles;

  // The map has been exchanged; grid: the new one, of the same cells.
  void move(const MapMove& move, const OccupancyGrid& grid);
};

// way_back: along the way that the robot has come, as through a passage.
enum class TaskKind { orbit, frontier, edge, opening, passage, way_back };

struct ExploreTask {
  TaskKind kind = TaskKind::frontier;
  Point about{0.0, 0.0};    // the middle of what is looked at
  CellGroup targets;        // of frontiers and edges
  Point lookout{0.0, 0.0};  // the first place that the path leads to
  std::vector<Point> path;
  double path_m = 0.0;  // of the path, to the lookout; an orbit continues behind it
  double cost_m = 0.0;
  // Of a passage: the lookout is before it, lined up, and the drive through it ends there.
  Point beyond_m{0.0, 0.0};
  bool is_suspect = false;  // an opening that is drawn shut
  double width_m = 0.0;     // of a passage, by the map or as it was heard
};

// None when nothing in reach is left. previous: what the robot is at, preferred when nearly as good.
[[nodiscard]] std::optional<ExploreTask> next_task(const FreeSpace& space, const Pose2& T_map_robot,
                                                   bool frontiers_wanted, const ExploreTask* previous,
                                                   const TaskSettings& settings, ExploreMemory& memory);

// For when nothing else is left: notes that a free-standing object which is not a known landmark is to be
// circled once more, since a second orbit often shows what the first did not. False when there is none.
bool look_again(const FreeSpace& space, const LandmarkGraph& known, const TaskSettings& settings,
                ExploreMemory& memory);

// For when enough is known: an opening that looks too narrow, to be looked at head on.
[[nodiscard]] std::optional<ExploreTask> opening_task(const FreeSpace& space, const FreeSpace& narrow,
                                                      const TaskSettings& settings, const ExploreMemory& memory);

// Not to be chosen again: what the task has from its lookout.
void give_up(const ExploreTask& task, const FreeSpace& space, const TaskSettings& settings, ExploreMemory& memory);

// False when most of what the task was for is known by now. Cheap: reads the task's cells only.
[[nodiscard]] bool still_worthwhile(const ExploreTask& task, const OccupancyGrid& grid, const TaskWeights& weights);

// Whether the sonars are turned to it at the end of the path.
[[nodiscard]] bool is_faced(TaskKind kind);

[[nodiscard]] std::string sentence_of(const ExploreTask& task);

}  // namespace cairn::behaviours
