#include "plugins/behaviours/exploring/task_chooser.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/behaviours/lookouts/frontiers.hpp"
#include "plugins/behaviours/lookouts/openings.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kEverywhere_m = 1e6;

// Whether what is in reach comes about as near to an edge as it can.
bool is_beside(const CellLayer<char>& reach, Cell edge, double min_cells) {
  const int cells = static_cast<int>(std::ceil(min_cells)) + 2;
  for (int dy = -cells; dy <= cells; ++dy)
    for (int dx = -cells; dx <= cells; ++dx)
      if (reach.at(edge + Cell{dx, dy})) return true;
  return false;
}

TaskSettings task_settings(const ExploreConfig& config, const RobotModel& robot) {
  TaskSettings settings;
  settings.orbit = {config.orbit_distance_m, config.look_closer_m, config.largest_object_m, config.object};
  settings.weights = config.exploring.weights;
  settings.openings = config.exploring.openings;
  settings.smallest_frontier_m = config.smallest_frontier_m;
  settings.gain_m = config.gain_m;
  settings.gain_range_m = std::min(farthest_range_m(robot), config.exploring.choice.trusted_range_m);
  return settings;
}

}  // namespace

TaskChooser::TaskChooser(const ExploreConfig& config, const WorldView& world)
    : config_(config),
      settings_(task_settings(config, world.robot)),
      near_echoes_(world.grid, config.driving.local_map.echoes.near),
      passed_(world.grid, config.exploring.passages.passed),
      opening_echoes_(config.exploring.passages.echoes),
      passages_(config.exploring.passages, config.exploring.passage_drive),
      known_(config.exploring.known) {}

void TaskChooser::begin_here(const WorldView& world) {
  forget_echoes(world);
  is_in_passage_ = false;
  memory_.trace.push_back(world.pose.T_map_robot);
}

void TaskChooser::forget_echoes(const WorldView& world) {
  spaces_.clear();
  near_echoes_ = NearEchoes(world.grid, config_.driving.local_map.echoes.near);
}

void TaskChooser::begin_in_new_map(const WorldView& world, const MapMove* move) {
  if (move == nullptr) {
    *this = TaskChooser(config_, world);
  } else {
    memory_.move(*move, world.grid);
    passages_.move(*move);
    passed_ = NearEchoes(world.grid, config_.exploring.passages.passed);
  }
}

void TaskChooser::begin_look(const WorldView& world, const Point& opening) {
  opening_echoes_.begin(opening, world.pose.T_map_robot.position());
}

void TaskChooser::look_through(const WorldView& world, const Point& opening) {
  if (world.observation == nullptr) return;
  const double to_m = (opening - world.pose.T_map_robot.position()).norm() + config_.exploring.passages.max_wall_m;
  near_echoes_.see_through(*world.observation, world.pose.T_map_robot, to_m);
  opening_echoes_.see(*world.observation, world.pose.T_map_robot);
}

std::optional<ExploreTask> TaskChooser::end_look(const ExploreTask& task, const WorldView& world) {
  behaviours::give_up(task, space(world), settings_, memory_);
  std::optional<ExploreTask> through = passages_.record_look(task, opening_echoes_.heard(), world.robot.radius_m);
  const bool is_wanted = through && !is_enough_known();
  if (!is_wanted) return std::nullopt;
  search_ = {kEverywhere_m, config_.clearance_m};
  const FreeSpace& usual = space(world);
  if (usual.reaches(usual.cell_at(through->beyond_m))) return std::nullopt;  // as usual, with more room
  return through;
}

void TaskChooser::see(const WorldView& world) {
  spaces_.clear();
  const Pose2& pose = world.pose.T_map_robot;
  if (world.observation != nullptr) {
    near_echoes_.see(*world.observation, pose);
    passed_.see(*world.observation, pose);
  }
  near_echoes_.stand_at(pose.position(), world.robot.radius_m + (is_in_passage_ ? world.grid.cell_m() : 0.0));
  const Pose2& last = memory_.trace.back();
  const ExploreMotionSettings& motion = config_.exploring.motion;
  if ((pose.position() - last.position()).norm() >= motion.trace_apart_m ||
      std::abs(wrap_angle(pose.theta_rad - last.theta_rad)) >= motion.trace_turn_rad)
    memory_.trace.push_back(pose);
}

CellBox TaskChooser::window_of(const Search& search, const WorldView& world) {
  const Cell here = world.grid.cell_at(world.pose.T_map_robot.position());
  const CellBox all = world.grid.bounds();
  const double max_cells = 1.0 + std::max(all.width(), all.height());
  const int reach = static_cast<int>(std::min(search.within_m / world.grid.cell_m(), max_cells));
  return CellBox{here, here + Cell{1, 1}}.grown(reach);
}

const FreeSpace& TaskChooser::space_within(const Search& search, const WorldView& world) const {
  if (const auto found = spaces_.find({search.within_m, search.clearance_m}); found != spaces_.end())
    return found->second;
  return spaces_.emplace(std::pair{search.within_m, search.clearance_m}, new_space(search, world)).first->second;
}

FreeSpace TaskChooser::new_space(const Search& search, const WorldView& world) const {
  const Point position = world.pose.T_map_robot.position();
  return FreeSpace(near_echoes_.applied_to(world.grid, window_of(search, world)),
                   {position, world.robot.radius_m, search.clearance_m, config_.driving.local_map.paths}, memory_.trace,
                   memory_.troubles);
}

std::optional<ExploreTask> TaskChooser::choose_within(const Search& search, const WorldView& world,
                                                      const std::optional<ExploreTask>& before) {
  search_ = search;
  const FreeSpace& space = space_within(search, world);
  settings_.window = window_of(search, world);
  const bool frontiers_wanted = !is_enough_known();
  // Each turn of the loop either ends it or gives a part of a task up.
  for (;;) {
    std::optional<ExploreTask> task =
        next_task(space, world.pose.T_map_robot, frontiers_wanted, before ? &*before : nullptr, settings_, memory_);
    if (!task) return std::nullopt;
    const bool is_there = length_of(task->path) < config_.exploring.choice.there_m;
    if (!is_there || is_faced(task->kind)) return task;
    behaviours::give_up(*task, space, settings_, memory_);
  }
}

std::optional<ExploreTask> TaskChooser::choose_again(const WorldView& world, const std::optional<ExploreTask>& before) {
  if (!config_.second_look || config_.look_closer_m <= 0.0) return std::nullopt;
  const Search search{kEverywhere_m, config_.clearance_m};
  if (!look_again(space_within(search, world), world.graph, settings_, memory_)) return std::nullopt;
  return choose_within(search, world, before);
}

// As long as not enough is known, passages are searched, which are more than these.
std::optional<ExploreTask> TaskChooser::choose_opening(const WorldView& world) {
  if (!is_enough_known()) return std::nullopt;
  search_ = {kEverywhere_m, config_.clearance_m};
  const double narrow_m = config_.exploring.choice.narrow_radius_m - world.robot.radius_m;
  return opening_task(space_within(search_, world), space_within({kEverywhere_m, narrow_m}, world), settings_, memory_);
}

std::optional<ExploreTask> TaskChooser::choose_far_edge(const WorldView& world,
                                                        const std::optional<ExploreTask>& before) {
  if (is_enough_known() || config_.exploring.choice.far_edge_cells == 0) return std::nullopt;
  settings_.far_edge_cells = config_.exploring.choice.far_edge_cells;
  std::optional<ExploreTask> task = choose_within({kEverywhere_m, config_.clearance_m}, world, before);
  settings_.far_edge_cells = 0;
  return task;
}

void TaskChooser::count_known(const WorldView& world) {
  const FreeSpace& space = space_within({kEverywhere_m, config_.exploring.choice.tight_clearance_m}, world);
  const double near_m = config_.look_closer_m > 0.0 ? config_.look_closer_m : config_.exploring.estimate.passed_m;
  const CellLayer<char> reach = reach_of(space, memory_.trace);
  std::vector<Cell> edges = edge_cells(space);
  std::erase_if(edges, [&](Cell c) { return !is_beside(reach, c, space.min_distance_m() / space.cell_m()); });
  const std::size_t left = unseen(space, edges, memory_.trace, {near_m}, memory_.seen_edges).size();
  const FreeSpace map = space_behind_walls(world, config_.clearance_m);
  const double hidden_m2 = passages_.suspected_m2({space, map, passed_.votes(), memory_.trace, world.robot.radius_m});
  known_.count(space, reach, left, config_.exploring.passages.drive_radius_m, world.time_s, passages_.closed(),
               hidden_m2);
}

// Walls that echoes have passed are not known to be there.
FreeSpace TaskChooser::space_behind_walls(const WorldView& world, double clearance_m) const {
  const CellBox window = window_of({kEverywhere_m, clearance_m}, world);
  OccupancyGrid map = near_echoes_.applied_to(world.grid, window);
  const CellBox box = map.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Cell c{x, y};
      if (passed_.is_conservatively_free(c) && map.state(c) == CellState::occupied) map.set_log_odds(c, 0);
    }
  const Point position = world.pose.T_map_robot.position();
  return FreeSpace(map, {position, world.robot.radius_m, clearance_m, config_.driving.local_map.paths}, memory_.trace,
                   memory_.troubles);
}

std::optional<ExploreTask> TaskChooser::choose_passage(const WorldView& world) {
  if (is_enough_known()) return std::nullopt;
  search_ = {kEverywhere_m, config_.clearance_m};
  const FreeSpace& usual = space(world);
  const FreeSpace map = space_behind_walls(world, config_.clearance_m);
  const PassageTasks::Explored explored{usual, map, passed_.votes(), memory_.trace, world.robot.radius_m};
  while (std::optional<ExploreTask> task = passages_.next(explored, world.pose.T_map_robot.position())) {
    if (!task->path.empty()) return task;
    search_ = {kEverywhere_m, std::min(config_.clearance_m, config_.exploring.choice.tight_clearance_m)};
    const FreeSpace& tight = space(world);
    task->path = tight.path_to(tight.cell_at(task->lookout));
    if (!task->path.empty()) return task;
    if (std::optional<ExploreTask> on_the_way = back_through_passage(task->lookout, world)) return on_the_way;
    task->path = path_as_before(task->lookout, world);
    if (!task->path.empty()) return task;
    passages_.record_unreachable(*task);
  }
  return std::nullopt;
}

// With as little room as passages are driven through with, then a cell less than the robot is wide: where it has stood
// is drawn that wide, so what it has come along is a path. The collision monitor is what sees to it then.
std::vector<Point> TaskChooser::path_as_before(const Point& to, const WorldView& world) {
  double least_m = config_.clearance_m;
  for (const double clearance_m : config_.exploring.passage_drive.clearances_m)
    least_m = std::min(least_m, clearance_m);
  for (const double clearance_m : {least_m, -world.grid.cell_m()}) {
    search_ = {kEverywhere_m, clearance_m};
    const FreeSpace& least = space(world);
    std::vector<Point> path = least.path_to(least.cell_at(to));
    if (!path.empty()) return path;
  }
  return {};
}

// As the robot came: with little room to the passage, then through it.
std::optional<ExploreTask> TaskChooser::back_through_passage(const Point& to, const WorldView& world) {
  const FreeSpace& slim = space_within({kEverywhere_m, slim_clearance_m(world.robot)}, world);
  std::optional<ExploreTask> through = passages_.passed_on(slim.path_to(slim.cell_at(to)), world.robot.radius_m);
  if (!through) return std::nullopt;
  search_ = {kEverywhere_m, std::min(config_.clearance_m, config_.exploring.choice.tight_clearance_m)};
  const FreeSpace& tight = space(world);
  through->path = tight.path_to(tight.cell_at(through->lookout));
  if (through->path.empty()) return std::nullopt;
  return through;
}

double TaskChooser::slim_clearance_m(const RobotModel& robot) const {
  return config_.exploring.passages.drive_radius_m - robot.radius_m;
}

std::optional<ExploreTask> TaskChooser::choose_behind_passages(const WorldView& world,
                                                               const std::optional<ExploreTask>& before) {
  const Search slim{kEverywhere_m, slim_clearance_m(world.robot)};
  while (const std::optional<ExploreTask> task = choose_within(slim, world, before)) {
    if (std::optional<ExploreTask> through = back_through_passage(task->lookout, world)) return through;
    search_ = slim;
    behaviours::give_up(*task, space(world), settings_, memory_);  // the robot has never been in there
  }
  return std::nullopt;
}

std::vector<NotEntered> TaskChooser::not_entered(const WorldView& world) const {
  const FreeSpace& usual = space_within({kEverywhere_m, config_.clearance_m}, world);
  return passages_.not_entered(
      {usual, space_behind_walls(world, config_.clearance_m), passed_.votes(), memory_.trace, world.robot.radius_m});
}

bool TaskChooser::is_shut_in(const WorldView& world) const {
  const FreeSpace& space = space_within({kEverywhere_m, config_.clearance_m}, world);
  const auto can_go_back = [&](const Pose2& pose) {
    const Cell centre = space.cell_at(pose.position());
    const int near = config_.exploring.choice.near_trace_cells;
    for (int dy = -near; dy <= near; ++dy)
      for (int dx = -near; dx <= near; ++dx)
        if (space.reaches(centre + Cell{dx, dy})) return true;
    return false;
  };
  const auto back = std::count_if(memory_.trace.begin(), memory_.trace.end(), can_go_back);
  return static_cast<double>(back) < config_.exploring.choice.shut_in_ratio * static_cast<double>(memory_.trace.size());
}

bool TaskChooser::leads_on(const WorldView& world, const Search& tight) const {
  return tighter_leads_on(space_within({tight.within_m, config_.clearance_m}, world), space_within(tight, world),
                          settings_.openings);
}

// The whole map only when there is nothing to do around here; less room only when shut in, or where a door seems narrow
// also from right ahead.
std::optional<ExploreTask> TaskChooser::choose(const WorldView& world, const std::optional<ExploreTask>& before) {
  std::erase_if(memory_.troubles, [&](const TroubleSpot& spot) { return spot.until_s < world.time_s; });
  if (known_.is_due(world.time_s)) count_known(world);
  const ChoiceSettings& choice = config_.exploring.choice;
  const Search tight{kEverywhere_m, std::min(config_.clearance_m, choice.tight_clearance_m)};
  if (auto task = choose_within({choice.around_m, config_.clearance_m}, world, before)) return task;
  if (auto task = choose_within({kEverywhere_m, config_.clearance_m}, world, before)) return task;
  if (is_shut_in(world))
    if (auto task = choose_within(tight, world, before)) return task;
  if (auto task = choose_opening(world)) return task;
  if (leads_on(world, tight))
    if (auto task = choose_within(tight, world, before)) return task;
  if (auto task = choose_far_edge(world, before)) return task;
  if (auto task = choose_passage(world)) return task;
  if (auto task = choose_behind_passages(world, before)) return task;
  search_ = {kEverywhere_m, config_.clearance_m};
  return choose_again(world, before);
}

void TaskChooser::give_up(const ExploreTask& task, const WorldView& world) {
  behaviours::give_up(task, space(world), settings_, memory_);
  if (task.kind == TaskKind::opening) passages_.record_unreachable(task);
  if (task.kind == TaskKind::passage) passages_.record(task, false, "blocked on the way to it");
}

bool TaskChooser::is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m) const {
  const ExploreMotionSettings& motion = config_.exploring.motion;
  const double margin_m = world.robot.radius_m + motion.blocked_clearance_ratio * search_.clearance_m;
  const auto is_occupied = [&](Cell c) { return near_echoes_.is_occupied(world.grid, c); };
  const auto blocks = [&](const std::vector<Point>& points, double from_m, double ahead_m) {
    return path_is_blocked(world.grid, is_occupied, points, from_m, ahead_m, margin_m);
  };
  // A robot that already stands too near to something is leaving a tight place and must not stop there.
  return blocks(path, along_m, motion.blocked_ahead_m) && !blocks({world.pose.T_map_robot.position()}, 0.0, 0.0);
}

std::optional<Point> TaskChooser::room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const {
  const FreeSpace& space = space_within({kEverywhere_m, config_.clearance_m}, world);
  return behaviours::room_out_of_reach(space, world.pose.T_map_robot.position(), done, settings_.openings);
}

std::optional<ExploreTask> TaskChooser::way_back(const WorldView& world) const {
  const Point robot = world.pose.T_map_robot.position();
  const auto away_m = [&](const Pose2& pose) { return (pose.position() - robot).norm(); };
  const double back_m = config_.exploring.blocked.way_back_m;
  const auto end = std::find_if(memory_.trace.rbegin(), memory_.trace.rend(),
                                [&](const Pose2& pose) { return away_m(pose) >= back_m; });
  if (end == memory_.trace.rend()) return std::nullopt;
  const auto middle =
      std::find_if(memory_.trace.rbegin(), end, [&](const Pose2& pose) { return away_m(pose) >= 0.5 * back_m; });
  ExploreTask task;
  task.kind = TaskKind::way_back;
  task.about = (middle == end ? *end : *middle).position();
  task.lookout = robot;
  task.beyond_m = end->position();
  return task;
}

}  // namespace cairn::behaviours
