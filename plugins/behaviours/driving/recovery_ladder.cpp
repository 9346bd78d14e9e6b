#include "plugins/behaviours/driving/recovery_ladder.hpp"

#include <algorithm>

#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {
namespace {

// Waiting for what moves by itself comes before what costs a detour: rounds 2, 4, 6 against 3, 5.
bool looks_in(int round) {
  return round % 2 == 0;
}
bool yields_in(int round) {
  return round >= 3 && !looks_in(round);
}

}  // namespace

void YieldSettings::describe(Fields<YieldSettings>& fields) {
  using C = YieldSettings;
  fields.number("min_away_m", &C::min_away_m, {0.0, 20.0}, "m",
                "the robot yields only to a place this far from what blocks it, less the cost of the path");
  fields.number("max_path_m", &C::max_path_m, {0.1, 50.0}, "m", "longest path to such a place");
  fields.number("path_weight", &C::path_weight, {0.0, 100.0}, "", "metres of distance that a metre of path costs");
  fields.number("clearance_m", &C::clearance_m, {0.0, 5.0}, "m", "room that the path keeps beside the robot");
  fields.number("for_s", &C::for_s, {0.0, 600.0}, "s", "it waits there at least this long");
  fields.number("drive_at_most_s", &C::drive_at_most_s, {1.0, 600.0}, "s",
                "when the drive there takes longer, it waits where it is: a car may have to manoeuvre");
}

void RecoverySettings::describe(Fields<RecoverySettings>& fields) {
  using C = RecoverySettings;
  fields.number("same_place_m", &C::same_place_m, {0.0, 50.0}, "m",
                "a blockage this near to the last one is at the same place: the next recovery is tried");
  fields.integer("max_blockages", &C::max_blockages, {1.0, 1e6},
                 "after so many blockages in all the drive is given up");
  fields.integer("max_back_up_times", &C::max_back_up_times, {1.0, 100.0},
                 "the robot backs up once as far the first time, twice the second, up to so many times");
  fields.number("ahead_m", &C::ahead_m, {0.0, 10.0}, "m",
                "the nearest obstacle within this of the robot's edge is what blocks it");
  fields.angle("ahead_deg", &C::ahead_rad, {0.0, 180.0}, "when it is within this angle of straight ahead");
  fields.number("avoid_for_s", &C::avoid_for_s, {0.0, 1e6}, "s", "paths avoid the place of a blockage for so long");
  fields.number("avoid_ahead_m", &C::avoid_ahead_m, {0.0, 10.0}, "m", "that place is this far before the robot's edge");
  fields.number("shut_for_s", &C::shut_for_s, {0.0, 1e6}, "s",
                "what blocked the robot on a path through unknown ground counts as an obstacle for so long");
  fields.group("back_up", &C::back_up, "backing up");
  fields.group("turn", &C::turn, "turning round to map afresh");
  fields.group("yield", &C::yield, "going aside for people who wait for the robot to leave");
}

std::vector<Point> path_aside(const FreeSpace& space, const Point& robot, const Point& from,
                              const YieldSettings& settings) {
  const Cell here = space.cell_at(robot);
  const int reach = static_cast<int>(settings.max_path_m / space.cell_m());
  std::optional<Cell> best;
  double best_m = settings.min_away_m;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = here + Cell{dx, dy};
      if (!space.reaches(c) || space.cost_m(c) > settings.max_path_m) continue;
      const double away_m = (space.centre_of(c) - from).norm() - settings.path_weight * space.cost_m(c);
      if (away_m <= best_m) continue;
      best_m = away_m;
      best = c;
    }
  }
  return best ? space.path_to(*best) : std::vector<Point>{};
}

Recovery RecoveryLadder::next(const Point& robot, const std::optional<Point>& blocked_by) {
  if ((robot - blocked_at_).norm() > settings_.same_place_m) round_ = 0;
  blocked_at_ = robot;
  blocked_by_ = blocked_by;
  ++round_;
  ++blockages_;
  if (round_ > rounds_ || blockages_ > settings_.max_blockages) return Recovery::give_up;
  return yields_in(round_) ? Recovery::yield : without_yielding();
}

void RecoveryLadder::move(const MapMove& move) {
  move_place(move, blocked_at_);
  if (blocked_by_) move_place(move, *blocked_by_);
}

Recovery RecoveryLadder::without_yielding() const {
  return looks_in(round_) && blocked_by_ ? Recovery::back_up_and_look : Recovery::back_up_and_turn;
}

int RecoveryLadder::back_up_times() const {
  return std::min(round_, settings_.max_back_up_times);
}

}  // namespace cairn::behaviours
