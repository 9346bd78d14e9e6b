// The map that planners are tried on, and an independent look at what they answer.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn::conformance {

// Two rooms joined by a door of 0.6 m, a third one without a door, cells of 0.1 m. Landmark 1 stands in the
// left room and 2 in the right one, joined by a route each way whose trajectory leads through the door;
// landmark 3 is in the closed room and no route leads there.
struct PlannerWorld {
  PlannerWorld();

  [[nodiscard]] WorldView view() const { return {grid, graph, robot, {}, 0.0, nullptr, 0.0}; }
  // Walls up the door and closes the routes through it.
  void close_door();
  // Nothing is known of the door's cells any more; the routes through it are closed.
  void forget_door();
  // The grid with the cells that a path crosses as '*'.
  [[nodiscard]] std::string drawing(const std::vector<Pose2>& path) const;

  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;
  Pose2 left{0.9, 3.7, 0.0};
  Pose2 right{3.3, 3.5, 0.0};
  Pose2 behind_walls{0.7, 0.4, 0.0};  // in the closed room
  Pose2 in_the_wall{2.1, 3.9, 0.0};   // between the rooms
  Pose2 outside{40.0, 40.0, 0.0};     // unknown ground, far off

 private:
  void set_door(LogOdds log_odds);
};

// Least distance from the points of a path, looked at every centimetre, to an occupied cell's square.
[[nodiscard]] double distance_to_occupied_m(const OccupancyGrid& grid, const std::vector<Pose2>& path);

}  // namespace cairn::conformance
