#include "plugins/behaviours/exploring/explore_tasks.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "plugins/behaviours/local_map/moved_cells.hpp"
#include "plugins/behaviours/lookouts/frontiers.hpp"
#include "plugins/behaviours/lookouts/information_gain.hpp"
#include "plugins/behaviours/lookouts/openings.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {
namespace {

struct Choice {
  double score_m = std::numeric_limits<double>::infinity();
  ExploreTask task;
};

Point middle_of(const FreeSpace& space, const CellGroup& cells) {
  Point sum{0.0, 0.0};
  for (const Cell c : cells) sum += space.centre_of(c);
  return sum / static_cast<double>(std::max<std::size_t>(1, cells.size()));
}

std::vector<CellGroup> groups_of(const std::vector<Cell>& cells, double min_cells) {
  std::vector<CellGroup> groups = grouped(cells, 1);
  std::erase_if(groups, [&](const CellGroup& g) { return static_cast<double>(g.size()) < min_cells; });
  return groups;
}

// A frontier that the robot does not fit through: a leak in a wall, the inside of an object.
bool is_crack(const FreeSpace& space, const CellGroup& frontier) {
  return std::none_of(frontier.begin(), frontier.end(),
                      [&](Cell c) { return space.distance_m(c) >= space.radius_m(); });
}

// Where a part of the map ends, what is beyond is not unknown: it is left out.
bool is_at_rim(const CellBox& window, Cell cell) {
  constexpr int kRim = 2;
  return !window.empty() && (cell.x < window.min.x + kRim || cell.y < window.min.y + kRim ||
                             cell.x >= window.max.x - kRim || cell.y >= window.max.y - kRim);
}

bool is_about_the_same(const ExploreTask& a, const ExploreTask& b, double same_m) {
  return a.kind == b.kind && ((a.lookout - b.lookout).norm() < same_m || (a.about - b.about).norm() < same_m);
}

void offer(Choice& best, ExploreTask task, double bonus_m, const ExploreTask* previous, const TaskWeights& weights) {
  if (previous != nullptr && is_about_the_same(*previous, task, weights.same_m)) bonus_m += weights.stay_bonus_m;
  if (task.cost_m - bonus_m >= best.score_m) return;
  best = {task.cost_m - bonus_m, std::move(task)};
}

// What groups of cells of one kind are worth.
struct Worth {
  TaskKind kind = TaskKind::frontier;
  double view_m = 1.0;         // looked at from within this distance
  double bonus_m_per_m = 0.0;  // of the group's length
  double small_m = 0.0;        // shorter groups are worth ...
  double max_m_per_m = 0.0;    // ... no longer path for each of their metres
  double gain_m = 0.0;         // > 0: the area that would be seen counts instead of the length
  double gain_range_m = 0.0;
  bool over_unknown = false;  // looked at over cells that are not known, too
};

void offer_groups(Choice& best, std::vector<CellGroup> groups, const Worth& worth, const FreeSpace& space,
                  const ExploreTask* previous, const TaskWeights& weights) {
  const std::vector<std::optional<Cell>> stands = lookouts(space, groups, worth.view_m, worth.over_unknown);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!stands[i]) continue;
    const double size_m = static_cast<double>(groups[i].size()) * space.cell_m();
    ExploreTask task;
    task.kind = worth.kind;
    task.about = middle_of(space, groups[i]);
    task.targets = std::move(groups[i]);
    task.lookout = space.centre_of(*stands[i]);
    task.cost_m = space.cost_m(*stands[i]);
    if (size_m < worth.small_m && task.cost_m > worth.max_m_per_m * size_m) continue;
    const double bonus_m = worth.gain_m > 0.0
                               ? worth_of_area_m(new_area_m2(space, task.lookout, worth.gain_range_m), worth.gain_m)
                               : std::min(weights.max_frontier_bonus_m, worth.bonus_m_per_m * size_m);
    offer(best, std::move(task), bonus_m, previous, weights);
  }
}

// An object that the robot has not been near to yet is an edge to look at: from afar a piece of wall looks the same.
// And a small rest of an orbit is worth a small detour only.
bool is_worth_an_orbit(const Orbit& orbit, double cost_m, const TaskWeights& weights) {
  const int open = orbit.count(SectorState::open);
  if (orbit.count(SectorState::covered) == 0 && cost_m > weights.orbit_from_m) return false;
  return open >= weights.min_orbit_sectors && cost_m <= weights.max_detour_for_sector_m * open;
}

const SecondLook* second_look_at(const ExploreMemory& memory, const Point& centre, double same_m) {
  const auto found = std::find_if(memory.second_looks.begin(), memory.second_looks.end(),
                                  [&](const SecondLook& look) { return (look.about - centre).norm() < same_m; });
  return found == memory.second_looks.end() ? nullptr : &*found;
}

void offer_orbits(Choice& best, const FreeSpace& space, const Pose2& T_map_robot, const ExploreTask* previous,
                  const TaskSettings& task_settings, const ExploreMemory& memory) {
  const OrbitSettings& settings = task_settings.orbit;
  const TaskWeights& weights = task_settings.weights;
  for (const CellGroup& object : compact_objects(space, settings.largest_object_m, settings.object)) {
    // A piece of a wall that goes on beyond what is searched.
    if (std::ranges::any_of(object, [&](Cell c) { return is_at_rim(task_settings.window, c); })) continue;
    // No orbit begins nearer than this.
    const double min_m =
        (middle_of(space, object) - T_map_robot.position()).norm() - settings.largest_object_m - settings.look_closer_m;
    if (min_m - weights.orbit_bonus_m - weights.stay_bonus_m >= best.score_m) continue;
    const SecondLook* again = second_look_at(memory, middle_of(space, object), weights.same_m);
    const auto trace = std::span(memory.trace).subspan(again == nullptr ? 0 : again->trace_from);
    const Orbit orbit = orbit_round(space, object, trace, memory.given_up_lookouts, settings);
    if (!orbit.is_round_trip(settings.object) || orbit.count(SectorState::open) == 0) continue;
    OrbitRoute route = orbit_route(space, orbit, T_map_robot);
    ExploreTask task;
    task.kind = TaskKind::orbit;
    task.about = orbit.centre;
    task.lookout = space.centre_of(route.first);
    task.path = std::move(route.path);
    task.path_m = route.path_m;
    task.cost_m = route.cost_m;
    const bool is_at_it = previous != nullptr && is_about_the_same(*previous, task, weights.same_m);
    if (!is_at_it && again == nullptr && !is_worth_an_orbit(orbit, task.cost_m, weights)) continue;
    offer(best, std::move(task), weights.orbit_bonus_m, previous, weights);
  }
}

}  // namespace

void ExploreMemory::move(const MapMove& move, const OccupancyGrid& grid) {
  move_places(move, trace);
  move_places(move, given_up_lookouts);
  move_places(move, seen_openings);
  for (SecondLook& look : second_looks) move_place(move, look.about);
  for (TroubleSpot& spot : troubles) move_place(move, spot.at_m);
  seen_edges = moved_cells(move, grid, seen_edges);
  seen_frontiers = moved_cells(move, grid, seen_frontiers);
}

std::optional<ExploreTask> next_task(const FreeSpace& space, const Pose2& T_map_robot, bool frontiers_wanted,
                                     const ExploreTask* previous, const TaskSettings& settings, ExploreMemory& memory) {
  Choice best;
  const TaskWeights& weights = settings.weights;
  const double look_closer_m = settings.orbit.look_closer_m;
  if (look_closer_m > 0.0) {
    const bool is_far = settings.far_edge_cells > 0;
    std::vector<Cell> edges = is_far ? far_edge_cells(space, settings.far_edge_cells) : edge_cells(space);
    std::erase_if(edges, [&](Cell c) { return is_far && is_at_rim(settings.window, c); });
    const std::vector<Cell> left = unseen(space, edges, memory.trace, {look_closer_m}, memory.seen_edges);
    Worth worth{TaskKind::edge, weights.view_ratio * look_closer_m, 0.0, weights.small_edge_m,
                weights.max_path_for_edges_m_per_m};
    worth.over_unknown = is_far;
    offer_groups(best, groups_of(left, weights.min_edge_m / space.cell_m()), worth, space, previous, weights);
  }
  if (frontiers_wanted) {
    const Sight sight{weights.frontier_view_m, weights.frontier_view_rad};
    std::vector<Cell> frontiers = frontier_cells(space);
    std::erase_if(frontiers, [&](Cell c) { return is_at_rim(settings.window, c); });
    const std::vector<Cell> left = unseen(space, frontiers, memory.trace, sight, memory.seen_frontiers);
    std::vector<CellGroup> groups = groups_of(left, settings.smallest_frontier_m / space.cell_m());
    std::erase_if(groups, [&](const CellGroup& group) { return is_crack(space, group); });
    Worth worth{TaskKind::frontier, weights.view_ratio * sight.within_m, weights.frontier_bonus_m_per_m};
    worth.gain_m = settings.gain_m;
    worth.gain_range_m = settings.gain_range_m;
    offer_groups(best, std::move(groups), worth, space, previous, weights);
  }
  if (look_closer_m > 0.0) offer_orbits(best, space, T_map_robot, previous, settings, memory);
  if (best.score_m == std::numeric_limits<double>::infinity()) return std::nullopt;
  if (best.task.path.empty()) best.task.path = space.path_to(space.cell_at(best.task.lookout));
  return std::move(best.task);
}

bool look_again(const FreeSpace& space, const LandmarkGraph& known, const TaskSettings& settings,
                ExploreMemory& memory) {
  bool found = false;
  for (const CellGroup& object : compact_objects(space, settings.orbit.largest_object_m, settings.orbit.object)) {
    const Point centre = middle_of(space, object);
    if (known.nearest(centre, settings.weights.is_landmark_m) != nullptr ||
        second_look_at(memory, centre, settings.weights.same_m) != nullptr)
      continue;
    if (!orbit_round(space, object, memory.trace, {}, settings.orbit).is_round_trip(settings.orbit.object)) continue;
    memory.second_looks.push_back({centre, memory.trace.size()});
    found = true;
  }
  return found;
}

std::optional<ExploreTask> opening_task(const FreeSpace& space, const FreeSpace& narrow, const TaskSettings& settings,
                                        const ExploreMemory& memory) {
  const std::optional<Opening> opening = nearest_opening(space, narrow, memory.seen_openings, settings.openings);
  if (!opening) return std::nullopt;
  ExploreTask task;
  task.kind = TaskKind::opening;
  task.about = opening->at_m;
  task.lookout = space.centre_of(opening->lookout);
  task.path = space.path_to(opening->lookout);
  task.cost_m = space.cost_m(opening->lookout);
  return task;
}

void give_up(const ExploreTask& task, const FreeSpace& space, const TaskSettings& settings, ExploreMemory& memory) {
  if (task.kind == TaskKind::orbit) {
    memory.given_up_lookouts.push_back(task.lookout);
    return;
  }
  if (task.kind == TaskKind::opening) {
    memory.seen_openings.push_back(task.about);
    return;
  }
  if (task.kind == TaskKind::passage) return;  // PassageTasks keeps count of these
  const bool is_frontier_task = task.kind == TaskKind::frontier;
  const double reach_m = settings.weights.give_up_ratio *
                         (is_frontier_task ? settings.weights.frontier_view_m : settings.orbit.look_closer_m);
  CellSet& set = is_frontier_task ? memory.seen_frontiers : memory.seen_edges;
  for (const Cell cell : task.targets) {
    if ((space.centre_of(cell) - task.lookout).norm() > reach_m) continue;
    // Outlines shift by a cell as evidence grows; what has shifted is still given up.
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) set.insert(cell + Cell{dx, dy});
  }
}

bool is_faced(TaskKind kind) {
  return kind == TaskKind::frontier || kind == TaskKind::opening;
}

bool still_worthwhile(const ExploreTask& task, const OccupancyGrid& grid, const TaskWeights& weights) {
  if (task.kind != TaskKind::frontier) return true;
  const auto is_open = [&](Cell c) {
    if (grid.state(c) == CellState::occupied) return false;
    return std::any_of(std::begin(kNeighbours), std::end(kNeighbours),
                       [&](Cell step) { return grid.state(c + step) == CellState::unknown; });
  };
  const auto left = std::count_if(task.targets.begin(), task.targets.end(), is_open);
  return static_cast<double>(left) > weights.worthwhile_ratio * static_cast<double>(task.targets.size());
}

std::string sentence_of(const ExploreTask& task) {
  const auto what = [&] {
    switch (task.kind) {
      case TaskKind::orbit:
        return "going round the object";
      case TaskKind::frontier:
        return "going to the frontier";
      case TaskKind::edge:
        return "looking closer at the edge";
      case TaskKind::passage:
        return "going through the opening";
      case TaskKind::way_back:
        return "going back the way it came";
      case TaskKind::opening:
        break;
    }
    return "looking into the narrow opening";
  };
  char text[96];
  std::snprintf(text, sizeof text, "%s at (%.2f, %.2f)", what(), task.about.x(), task.about.y());
  return text;
}

}  // namespace cairn::behaviours
