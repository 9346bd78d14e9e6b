// Which recovery comes next when the robot makes no progress: one rung after the other at one place, then the drive is
// given up. Waiting was the first rung. A blockage elsewhere begins the ladder anew.
#pragma once

#include <optional>
#include <vector>

#include "maps/geometry/map_move.hpp"
#include "plugins/behaviours/following/back_up.hpp"
#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

// Going aside for whoever waits for the robot.
struct YieldSettings {
  double min_away_m = 0.8;
  double max_path_m = 2.5;
  double path_weight = 0.3;
  double clearance_m = 0.08;
  double for_s = 8.0;
  double drive_at_most_s = 30.0;
  static void describe(Fields<YieldSettings>& fields);
};

struct RecoverySettings {
  double same_place_m = 0.8;
  int max_blockages = 40;
  int max_back_up_times = 3;
  double ahead_m = 0.5;
  double ahead_rad = radians(60.0);
  double avoid_for_s = 60.0;
  double avoid_ahead_m = 0.1;
  double shut_for_s = 200.0;  // long enough to try the other gaps of a wall that sonars leak through
  BackUpSettings back_up;
  TurnRoundSettings turn;
  YieldSettings yield;
  static void describe(Fields<RecoverySettings>& fields);
};

// The path to where the robot does not block somebody: far from them, less what the path costs. None: nowhere.
[[nodiscard]] std::vector<Point> path_aside(const FreeSpace& space, const Point& robot, const Point& from,
                                            const YieldSettings& settings);

enum class Recovery { back_up_and_turn, back_up_and_look, yield, give_up };

class RecoveryLadder {
 public:
  RecoveryLadder(const RecoverySettings& settings, int rounds) : settings_(settings), rounds_(rounds) {}

  // A new blockage; blocked_by: what is ahead, where that is known.
  [[nodiscard]] Recovery next(const Point& robot, const std::optional<Point>& blocked_by);
  // What comes instead of yielding where there is nowhere to go, and once the robot has backed up.
  [[nodiscard]] Recovery without_yielding() const;

  // The map has been exchanged.
  void move(const MapMove& move);

  [[nodiscard]] int round() const { return round_; }
  [[nodiscard]] const Point& blocked_at() const { return blocked_at_; }
  [[nodiscard]] const std::optional<Point>& blocked_by() const { return blocked_by_; }
  // Farther, round after round.
  [[nodiscard]] int back_up_times() const;
  // The planner knows nothing of what blocks the robot: every second round a path round it is looked for.
  [[nodiscard]] bool plans_round_it() const { return round_ >= 2 && round_ % 2 == 0; }

 private:
  RecoverySettings settings_;
  int rounds_;
  int round_ = 0;      // at this place
  int blockages_ = 0;  // in all
  Point blocked_at_{1e9, 1e9};
  std::optional<Point> blocked_by_;
};

}  // namespace cairn::behaviours
