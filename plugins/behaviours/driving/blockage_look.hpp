// Looks at what blocks the robot: faces it until it is gone, or for long enough.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "plugins/behaviours/local_map/doubts.hpp"
#include "plugins/behaviours/local_map/local_obstacles.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::behaviours {

struct LookSettings {
  int max_looks = 12;
  int first_round_looks = 6;
  double at_least_s = 3.0;
  double at_most_s = 25.0;
  double drive_at_most_s = 120.0;
  double stand_off_m = 0.8;
  double stand_off_nearer_m = 0.5;
  double around_m = 1.0;
  double opened_m = 0.7;
  int seen_through_ticks = 10;
  int max_ticks = 50;
  double sweep_rad = radians(25.0);
  double sweep_s = 4.0;
  double turn_radps = radians(45.0);
  double beside_goal_m = 0.5;
  double beside_goal_at_most_s = 6.0;
  double beside_goal_apart_m = 0.3;
  double before_goal_m = 0.1;
  double island_radius_m = 0.7;
  static void describe(Fields<LookSettings>& fields);
};

class BlockageLook {
 public:
  struct Target {
    Point at{0.0, 0.0};
    double at_least_s = 3.0;
    double at_most_s = 25.0;  // for a door to open
    bool is_goal = false;     // the goal is blocked, and looked at from beside
    bool is_live = false;     // it blocked the robot, whatever the map has there
  };

  explicit BlockageLook(const LookSettings& settings = {}) : settings_(settings) {}

  // The usual times.
  [[nodiscard]] Target target_at(const Point& at) const;
  // What is looked at from now on; what was seen of the last target is forgotten.
  void aim_at(const Target& target);
  [[nodiscard]] const Target& target() const { return target_; }

  // Looks that the robot drives to are counted: after the first round all places are looked at once more.
  [[nodiscard]] bool may_drive_to_look() const { return looks_ < settings_.max_looks; }
  [[nodiscard]] double stand_off_m() const;
  void count_drive();
  [[nodiscard]] int looks() const { return looks_; }
  void remember_looked_at(const Point& at) { looked_at_.push_back(at); }
  [[nodiscard]] const std::vector<Point>& looked_at() const { return looked_at_; }
  // Where the robot stood to look at a blocked goal.
  void remember_stood_at(const Point& at) { stood_beside_goal_.push_back(at); }
  [[nodiscard]] const std::vector<Point>& stood_beside_goal() const { return stood_beside_goal_; }

  // The map has been exchanged: what was seen of the target is forgotten, places move along.
  void move(const MapMove& move);

  // A turn towards the target, sweeping to both sides: readings from one pose repeat themselves.
  [[nodiscard]] Twist turn(const WorldView& world, double looked_s, const motion::TurnSettings& turn) const;
  // Every tick of a look. True when what blocked the robot has gone: echoes come from behind it. What the map has there
  // is gone when nothing stands at the place, or the echoes pass enough of what is held occupied about it: a door's
  // width.
  [[nodiscard]] bool has_opened(const WorldView& world, const NearEchoes& echoes, const LocalObstacles& obstacles);
  [[nodiscard]] Doubts doubts() const;

 private:
  [[nodiscard]] std::vector<Cell> seen_through() const;
  [[nodiscard]] bool is_seen_through(Cell cell) const;

  LookSettings settings_;
  Target target_;
  std::map<Cell, int> through_;  // occupied cells about the target: ticks that they were seen through, less the others
  int looks_ = 0;
  std::vector<Point> looked_at_;
  std::vector<Point> stood_beside_goal_;
};

}  // namespace cairn::behaviours
