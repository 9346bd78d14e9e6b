#include "plugins/behaviours/local_map/local_map.hpp"

#include <algorithm>
#include <cstdlib>

#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr int kMaxAcross_cells = 1000;  // a goal further off would need too large a map

// Within what is known and about the goal.
void take_unknown_for_free(OccupancyGrid& map, const Point& goal, double around_m) {
  const Cell to = map.cell_at(goal);
  const int around = static_cast<int>(around_m / map.cell_m());
  const CellBox known = map.bounds();
  CellBox box = CellBox{to, to + Cell{1, 1}}.grown(around);
  box = known.empty() ? box : united(known, box);
  if (box.width() > kMaxAcross_cells || box.height() > kMaxAcross_cells) return;
  const LogOdds free = log_odds_of(kFree);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (map.state({x, y}) == CellState::unknown) map.set_log_odds({x, y}, free);
}

void occupy_around(const Point& p, double radius_m, OccupancyGrid& map) {
  const Cell at = map.cell_at(p);
  const int reach = static_cast<int>(radius_m / map.cell_m());
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= reach * reach) map.set_log_odds(at + Cell{dx, dy}, log_odds_of(1.0 - kFree));
}

}  // namespace

void LocalMapSettings::describe(Fields<LocalMapSettings>& fields) {
  using C = LocalMapSettings;
  fields.number("around_m", &C::around_m, {1.0, 200.0}, "m", "the part of the map about the robot that is searched");
  fields.number("clearance_m", &C::clearance_m, {0.0, 5.0}, "m", "room that its paths keep beside the robot");
  fields.number("tight_clearance_m", &C::tight_clearance_m, {0.0, 5.0}, "m", "the same where there is no other path");
  fields.number("escape_clearance_m", &C::escape_clearance_m, {0.0, 5.0}, "m",
                "a robot too near to something to plan drives to where it has this room");
  fields.number("trace_apart_m", &C::trace_apart_m, {0.01, 5.0}, "m",
                "where the robot was is remembered at this spacing, and is free");
  fields.integer("max_trace", &C::max_trace, {1.0, 1e6}, "so many places are remembered");
  fields.number("around_goal_m", &C::around_goal_m, {0.0, 50.0}, "m",
                "unknown ground about the goal is taken to be free within this, when unknown ground is");
  fields.number("shut_radius_m", &C::shut_radius_m, {0.0, 5.0}, "m",
                "what blocked the robot on a path through unknown ground counts as an obstacle of this radius");
  fields.group("echoes", &C::echoes, "how near echoes correct the map");
  fields.group("paths", &C::paths, "what its paths prefer");
  fields.group("speckles", &C::speckles, "what is taken for a speckle");
}

void LocalMap::see(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  echoes_.see(world);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() > settings_.trace_apart_m)
    trace_.push_back(pose);
  if (trace_.size() > static_cast<std::size_t>(settings_.max_trace)) trace_.erase(trace_.begin());
  for (std::vector<TroubleSpot>* spots : {&avoided_, &shut_})
    std::erase_if(*spots, [&](const TroubleSpot& spot) { return spot.until_s < world.time_s; });
}

// What was seen through; speckles; and whatever stands alone where the robot has looked: it is there if it echoes.
std::vector<Cell> LocalMap::doubtful_cells(const OccupancyGrid& map, const Doubts& doubts) const {
  std::vector<Cell> cells = doubts.seen_through;
  const std::vector<Cell> speckles = speckles_of(map, map.bounds(), settings_.speckles);
  cells.insert(cells.end(), speckles.begin(), speckles.end());
  const int around = static_cast<int>(doubts.island_radius_m / map.cell_m());
  for (const Point& seen : doubts.looked_at) {
    const Cell at = map.cell_at(seen);
    const CellBox box = CellBox{at, at + Cell{1, 1}}.grown(around);
    const int all = box.width() * box.height();
    const std::vector<Cell> islands = speckles_of(map, box, {all, all});
    cells.insert(cells.end(), islands.begin(), islands.end());
  }
  return cells;
}

FreeSpace LocalMap::space(const WorldView& world, double clearance_m, Optimism optimism, const Point& goal,
                          const Doubts& doubts) const {
  const Point position = world.pose.T_map_robot.position();
  const Cell here = world.grid.cell_at(position);
  const int reach = static_cast<int>(settings_.around_m / world.grid.cell_m());
  const CellBox part = CellBox{here, here + Cell{1, 1}}.grown(reach);
  OccupancyGrid map = echoes_.now().applied_to(world.grid, part);
  if (optimism != Optimism::none)
    for (const Cell c : doubtful_cells(map, doubts)) map.set_log_odds(c, log_odds_of(kFree));
  if (optimism >= Optimism::unknown_free) {
    take_unknown_for_free(map, goal, settings_.around_goal_m);
    for (const TroubleSpot& spot : shut_) occupy_around(spot.at_m, settings_.shut_radius_m, map);
  }
  return FreeSpace(map, {position, world.robot.radius_m, clearance_m, settings_.paths}, trace_, avoided_);
}

bool LocalMap::is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m, double ahead_m,
                          double radius_m) const {
  const auto is_occupied = [&](Cell c) { return echoes_.now().is_occupied(world.grid, c) && !ignored_.contains(c); };
  return path_is_blocked(world.grid, is_occupied, path, along_m, ahead_m, radius_m);
}

// A cell beside it will do: poses shift by that much between the blockage and the look.
void LocalMap::reopen(const OccupancyGrid& map, const std::vector<Cell>& seen_through) {
  std::erase_if(shut_, [&](const TroubleSpot& spot) {
    const Cell at = map.cell_at(spot.at_m);
    return std::ranges::any_of(seen_through,
                               [&](Cell c) { return std::max(std::abs(c.x - at.x), std::abs(c.y - at.y)) <= 1; });
  });
}

void LocalMap::ignore(const std::vector<Cell>& cells, const WorldView& world, const Doubts& doubts) {
  for (const Cell c : cells) {
    ignored_.insert(c);
    if (!doubts.gone.contains(c) && echoes_.now().is_occupied(world.grid, c))
      ignored_places_.push_back(world.grid.centre_of(c));
  }
}

void LocalMap::ignore_doubtful(Optimism optimism, const WorldView& world, const Doubts& doubts) {
  if (optimism == Optimism::none) return;
  ignore(doubtful_cells(echoes_.now().applied_to(world.grid, world.grid.bounds()), doubts), world, doubts);
}

void LocalMap::ignore_along(const std::vector<Point>& path, const WorldView& world, const Doubts& doubts) {
  const double cell_m = world.grid.cell_m();
  const int reach = static_cast<int>((world.robot.radius_m + settings_.tight_clearance_m) / cell_m) + 1;
  std::vector<Cell> cells;
  for (double along_m = 0.0; along_m < length_of(path); along_m += cell_m) {
    const Cell centre = world.grid.cell_at(motion::point_along(path, along_m));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (dx * dx + dy * dy <= reach * reach) cells.push_back(centre + Cell{dx, dy});
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  ignore(cells, world, doubts);
}

void LocalMap::ignore_nothing() {
  ignored_ = {};
  ignored_places_.clear();
}

bool LocalMap::ignores_near(const Point& p, double within_m) const {
  return std::ranges::any_of(ignored_places_, [&](const Point& q) { return (q - p).norm() < within_m; });
}

}  // namespace cairn::behaviours
