#include "plugins/behaviours/driving/blockage_look.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/behaviours/places/map_watch.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {

void LookSettings::describe(Fields<LookSettings>& fields) {
  using C = LookSettings;
  fields.integer("max_looks", &C::max_looks, {0.0, 1000.0},
                 "how often the robot drives somewhere to look whether a blockage has gone");
  fields.integer("first_round_looks", &C::first_round_looks, {0.0, 1000.0},
                 "after so many looks each place is looked at once more, from nearer");
  fields.number("at_least_s", &C::at_least_s, {0.0, 600.0}, "s", "a look takes at least this");
  fields.number("at_most_s", &C::at_most_s, {0.0, 3600.0}, "s", "and at most this, for a door to open");
  fields.number("drive_at_most_s", &C::drive_at_most_s, {1.0, 3600.0}, "s",
                "when the drive to a look takes longer, it looks from where it is");
  fields.number("stand_off_m", &C::stand_off_m, {0.1, 10.0}, "m", "from the blockage to where the robot looks at it");
  fields.number("stand_off_nearer_m", &C::stand_off_nearer_m, {0.1, 10.0}, "m", "the same when all is looked at again");
  fields.number("around_m", &C::around_m, {0.1, 10.0}, "m", "what changes within this of the blockage counts");
  fields.number("opened_m", &C::opened_m, {0.05, 10.0}, "m",
                "a blockage of the map has gone when echoes pass so much of it: a door's width");
  fields.integer("seen_through_ticks", &C::seen_through_ticks, {1.0, 10000.0},
                 "a cell has gone when echoes came from behind it in so many more ticks than not");
  fields.integer("max_ticks", &C::max_ticks, {1.0, 100000.0}, "no more ticks count, for or against");
  fields.angle("sweep_deg", &C::sweep_rad, {0.0, 180.0}, "while it looks the robot turns to both sides by this");
  fields.number("sweep_s", &C::sweep_s, {0.1, 100.0}, "s", "period of that sweep");
  fields.angle("turn_degps", &C::turn_radps, {1.0, 360.0}, "fastest turn while it looks", "deg/s");
  fields.number("beside_goal_m", &C::beside_goal_m, {0.0, 10.0}, "m",
                "a blocked goal is looked at from within this of the robot's edge");
  fields.number("beside_goal_at_most_s", &C::beside_goal_at_most_s, {0.0, 3600.0}, "s", "for at most this");
  fields.number("beside_goal_apart_m", &C::beside_goal_apart_m, {0.0, 10.0}, "m",
                "each time from a place at least this far from the earlier ones");
  fields.number("before_goal_m", &C::before_goal_m, {0.0, 10.0}, "m",
                "a place this far before the goal must be in sight: the goal itself may be drawn into a wall");
  fields.number("island_radius_m", &C::island_radius_m, {0.0, 10.0}, "m",
                "isolated groups of cells within this of what was looked at are doubted");
}

BlockageLook::Target BlockageLook::target_at(const Point& at) const {
  Target target;
  target.at = at;
  target.at_least_s = settings_.at_least_s;
  target.at_most_s = settings_.at_most_s;
  return target;
}

void BlockageLook::aim_at(const Target& target) {
  target_ = target;
  through_.clear();
}

void BlockageLook::move(const MapMove& move) {
  through_.clear();
  move_place(move, target_.at);
  move_places(move, looked_at_);
  move_places(move, stood_beside_goal_);
}

double BlockageLook::stand_off_m() const {
  return looks_ < settings_.first_round_looks ? settings_.stand_off_m : settings_.stand_off_nearer_m;
}

void BlockageLook::count_drive() {
  if (++looks_ == settings_.first_round_looks + 1) looked_at_.clear();
}

Twist BlockageLook::turn(const WorldView& world, double looked_s, const motion::TurnSettings& turn) const {
  const double aside_rad = settings_.sweep_rad * std::sin(2.0 * std::numbers::pi * looked_s / settings_.sweep_s);
  const double error_rad = wrap_angle(motion::heading_error(world.pose.T_map_robot, target_.at) + aside_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  return can_turn ? motion::turn_by(error_rad, std::min(settings_.turn_radps, world.robot.max_w_radps), turn) : Twist{};
}

bool BlockageLook::has_opened(const WorldView& world, const NearEchoes& echoes, const LocalObstacles& obstacles) {
  const OccupancyGrid& grid = world.grid;
  const Cell at = grid.cell_at(target_.at);
  const int reach = static_cast<int>(settings_.around_m / grid.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      if (c != at && !echoes.is_occupied(grid, c)) continue;
      const LocalObstacles::Live live = obstacles.live_echo_at(grid.centre_of(c), world.time_s);
      if (live == LocalObstacles::Live::silent) continue;
      int& ticks = through_[c];
      ticks =
          std::clamp(ticks + (live == LocalObstacles::Live::there ? -1 : 1), -settings_.max_ticks, settings_.max_ticks);
    }
  }
  if (target_.is_live) return is_seen_through(at);
  if (!echoes.is_occupied(grid, at)) return true;
  return static_cast<double>(seen_through().size()) * grid.cell_m() > settings_.opened_m;
}

bool BlockageLook::is_seen_through(Cell cell) const {
  const auto found = through_.find(cell);
  return found != through_.end() && found->second >= settings_.seen_through_ticks;
}

Doubts BlockageLook::doubts() const {
  CellSet gone;
  for (const auto& [cell, ticks] : through_)
    if (ticks >= 0) gone.insert(cell);
  return {seen_through(), std::move(gone), looked_at_, settings_.island_radius_m};
}

std::vector<Cell> BlockageLook::seen_through() const {
  std::vector<Cell> cells;
  for (const auto& [cell, ticks] : through_)
    if (ticks >= settings_.seen_through_ticks) cells.push_back(cell);
  return cells;
}

}  // namespace cairn::behaviours
