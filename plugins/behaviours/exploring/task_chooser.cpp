// What exploring chooses next, and on which part of the map.

#include <algorithm>

#include "plugins/behaviours/driving/openings.hpp"
#include "plugins/behaviours/exploring/exploration.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kEverywhere_m = 1e6;

}  // namespace

FreeSpace Exploration::space_now(const WorldView& world, const Search& search) const {
  const Point position = world.pose.T_map_robot.position();
  const Cell here = world.grid.cell_at(position);
  const CellBox all = world.grid.bounds();
  const double max_cells = 1.0 + std::max(all.width(), all.height());
  const int reach = static_cast<int>(std::min(search.within_m / world.grid.cell_m(), max_cells));
  const CellBox part = CellBox{here, here + Cell{1, 1}}.grown(reach);
  return FreeSpace(near_echoes_.applied_to(world.grid, part),
                   {position, world.robot.radius_m, search.clearance_m, config_.driving.local_map.paths}, memory_.trace,
                   memory_.troubles);
}

bool Exploration::choose_by(const Search& search, const WorldView& world, const std::optional<ExploreTask>& before) {
  search_ = search;
  const FreeSpace space = space_now(world, search);
  const bool frontiers_wanted = known_ratio(world.grid) < config_.until_known_ratio;
  // Each turn of the loop either ends it or gives a part of a task up.
  for (;;) {
    task_ = next_task(space, world.pose.T_map_robot, frontiers_wanted, before ? &*before : nullptr, settings_, memory_);
    if (!task_) return false;
    const bool is_there = motion::length_of(task_->path) < config_.exploring.choice.there_m;
    if (!is_there || is_to_be_faced()) return true;
    give_up(*task_, space, settings_, memory_);
  }
}

bool Exploration::choose_again(const WorldView& world, const std::optional<ExploreTask>& before) {
  if (!config_.second_look || config_.look_closer_m <= 0.0) return false;
  const Search search{kEverywhere_m, config_.clearance_m};
  return look_again(space_now(world, search), world.graph, settings_, memory_) && choose_by(search, world, before);
}

bool Exploration::choose_opening(const WorldView& world) {
  search_ = {kEverywhere_m, config_.clearance_m};
  const FreeSpace space = space_now(world, search_);
  const FreeSpace narrow =
      space_now(world, {kEverywhere_m, config_.exploring.choice.narrow_radius_m - world.robot.radius_m});
  task_ = opening_task(space, narrow, settings_, memory_);
  return task_.has_value();
}

// Noise can wall the robot in where it just came through: it cannot go back to where it has been.
bool Exploration::is_shut_in(const WorldView& world) const {
  const FreeSpace space = space_now(world, {kEverywhere_m, config_.clearance_m});
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

bool Exploration::leads_on(const WorldView& world, const Search& tight) const {
  return tighter_leads_on(space_now(world, {tight.within_m, config_.clearance_m}), space_now(world, tight),
                          settings_.openings);
}

bool Exploration::choose(const WorldView& world, BehaviourContext& context) {
  std::erase_if(memory_.troubles, [&](const TroubleSpot& spot) { return spot.until_s < world.time_s; });
  chosen_s_ = world.time_s;
  // The whole map only when there is nothing to do around here; less room only when shut in, or where a door seems
  // narrow also from right ahead.
  const std::optional<ExploreTask> before = task_;
  const Search tight{kEverywhere_m, std::min(config_.clearance_m, config_.exploring.choice.tight_clearance_m)};
  const bool found = choose_by({config_.exploring.choice.around_m, config_.clearance_m}, world, before) ||
                     choose_by({kEverywhere_m, config_.clearance_m}, world, before) ||
                     (is_shut_in(world) && choose_by(tight, world, before)) || choose_again(world, before) ||
                     choose_opening(world) || (leads_on(world, tight) && choose_by(tight, world, before));
  if (!found) return false;
  path_.take(task_->path);
  if (task_->kind == TaskKind::orbit && (task_->about - said_about_).norm() > config_.orbit_distance_m) {
    said_about_ = task_->about;
    context.say(sentence_of(*task_));
  }
  return true;
}

std::optional<Point> Exploration::room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const {
  const FreeSpace space = space_now(world, {kEverywhere_m, config_.clearance_m});
  return behaviours::room_out_of_reach(space, world.pose.T_map_robot.position(), done, settings_.openings);
}

}  // namespace cairn::behaviours
