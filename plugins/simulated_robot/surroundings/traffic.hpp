// The doors and movers of a world, from tick to tick.
//
// A door whose time has come closes when the robot is clear of its leaf, and opens when that time is over. A mover goes
// along its path, stops where it would come too near to the robot, and goes on when that is gone. Where they are
// follows from the simulated time, the world and where the robot has been: there is no chance in it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/surroundings/body.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

// How far the outline of each moving thing is shifted, doors first; nothing for an open door.
using Places = std::vector<std::optional<Point>>;

class Traffic {
 public:
  // As it is at time 0.
  Traffic(const World& world, const RobotModel& robot, const Pose2& T_map_start);
  Traffic(const Traffic&) = delete;  // its parts refer to each other
  Traffic& operator=(const Traffic&) = delete;

  // Until time_s, which is period_s later than before, while the robot stands. Nothing comes to overlap it.
  void advance(double time_s, double period_s, const Pose2& T_map_robot);

  [[nodiscard]] bool is_empty() const { return outlines_.empty(); }
  [[nodiscard]] const Places& places() const { return places_; }
  // A mover that does not wait was stopped by the robot in the last advance().
  [[nodiscard]] bool touches_robot() const { return touches_; }

  // The scene with everything at these places.
  void show(const Places& places, Scene& scene) const;
  // What the robot would overlap at this pose now ("mover 2 (cart)"), or nothing.
  [[nodiscard]] std::optional<std::string> blocker_at(const Pose2& T_map_robot) const;

 private:
  struct Walk {
    Point at_m;
    std::size_t next = 1;  // the path's point that it goes to
    bool back = false;     // against the order of the path
    bool ended = false;
    double rest_s = 0.0;
  };

  [[nodiscard]] bool is_clear_of(const WorldDoor& door, const Point& robot_m) const;
  void walk(std::size_t mover, double for_s, const Pose2& T_map_robot);
  static void arrive(const WorldMover& mover, Walk& walk);

  std::vector<WorldDoor> doors_;
  std::vector<WorldMover> movers_;
  double reach_m_ = 0.0;          // of the robot's footprint from its centre
  std::deque<Scene> outlines_;    // one a moving thing, doors first; bodies refer to them
  std::vector<Body> footprints_;  // the robot's, among that outline alone
  std::vector<Walk> walks_;
  Places places_;
  bool touches_ = false;
};

}  // namespace cairn
