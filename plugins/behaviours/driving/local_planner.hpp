// Reactive avoidance below a route: the dynamic window approach.
//
// Fox, Burgard, Thrun: The dynamic window approach to collision avoidance, IEEE Robotics & Automation Magazine 4(1),
// 1997. Candidate velocities are those that the robot can reach within its accelerations; one is admissible when the
// robot can stop on its arc before the first obstacle (eq. 14); the best one weighs heading, clearance and speed
// (eq. 13). The velocity that the path follower prefers is taken as it is where its own arc is free, so that in the
// open the robot follows its path exactly.
#pragma once

#include <vector>

#include "framework/contracts/world_view.hpp"
#include "plugins/behaviours/driving/cell_layer.hpp"
#include "plugins/behaviours/driving/near_echoes.hpp"

namespace cairn::behaviours {

struct LocalLimits {
  double max_v_mps = 0.25;
  double max_w_radps = 0.9;
  double acceleration_mps2 = 0.5;
  double turn_acceleration_radps2 = 3.5;
  double min_turning_radius_m = 0.0;  // > 0: a car
  double radius_m = 0.22;             // of the disc that the footprint fits in
  double clearance_m = 0.07;          // kept beyond it where there is room; more than the stop layer's margin
};
[[nodiscard]] LocalLimits local_limits(const RobotModel& robot, double speed_mps);

// Metres of the arc of a twist (backwards for v < 0) that a disc about the robot's origin can go before its centre is
// within reach_m of an obstacle (robot frame); +inf when it never is. An obstacle that is within reach already only
// counts while the disc comes nearer to it. v must not be 0.
[[nodiscard]] double free_distance_m(const Twist& twist, const std::vector<Point>& obstacles, double reach_m);

struct LocalWish {
  Twist preferred;      // by the path follower
  Point aim{0.0, 0.0};  // on the path, robot frame
};

struct LocalStep {
  Twist target;          // what the window's best candidate is
  bool blocked = false;  // nothing admissible leads on: target is a stop
};

// The velocity to go for. Obstacles in the robot frame. Pure: the same in gives the same out.
[[nodiscard]] LocalStep best_in_window(const Twist& now, const LocalWish& wish, const std::vector<Point>& obstacles,
                                       const LocalLimits& limits);

// One tick's change of velocity towards the target, within the accelerations.
[[nodiscard]] Twist approached(const Twist& now, const Twist& target, double passed_s, const LocalLimits& limits);

// Keeps what is near the robot, and the velocity it goes at: the state of a behaviour that avoids obstacles.
class LocalPlanner {
 public:
  // Every tick. What the grid (as corrected by near echoes) holds occupied, but for doubted cells and those that a live
  // echo has passed through, and the last echo of each transducer,
  // on its whole arc unless something known explains it.
  void see(const WorldView& world, const NearEchoes& near_echoes, const CellSet& doubted = {});
  // The velocity for this tick; after see(). aim_map: the point of the path that the preferred velocity goes for.
  [[nodiscard]] Twist steer(const Twist& preferred, const Point& aim_map, double speed_mps, const WorldView& world);
  // Ordered without avoidance (turns in place, backing up): the next window begins there.
  [[nodiscard]] Twist approach(const Twist& target, const WorldView& world);

  [[nodiscard]] bool is_blocked() const { return blocked_; }
  // What the live echoes (not silence) say of a place: something is there, nothing is, or neither.
  enum class Live { silent, there, seen_through };
  [[nodiscard]] Live live_echo_at(const Point& p_map, double time_s) const;
  // In the robot frame, as of the last see().
  [[nodiscard]] const std::vector<Point>& obstacles() const { return obstacles_; }

 private:
  struct Echo {
    double stamp_s = -1e9;
    double range_m = 0.0;  // +inf: none
    double half_beam_rad = 0.0;
    Pose2 T_map_sensor;
    std::vector<Point> points_map;
  };
  [[nodiscard]] static bool is_explained(const Echo& echo, const std::vector<Point>& there_map);
  void gather_cells(const WorldView& world, const NearEchoes& near_echoes, const CellSet& doubted);
  void add(const RangeReading& reading, const WorldView& world);
  [[nodiscard]] Twist now(const WorldView& world) const;

  std::vector<Point> cells_map_;
  double gathered_s_ = -1e9;
  std::vector<Echo> echoes_;  // by transducer
  std::vector<Point> obstacles_;
  Twist last_ordered_;
  double last_s_ = -1e9;
  double passed_s_ = 0.0;
  bool blocked_ = false;
};

}  // namespace cairn::behaviours
