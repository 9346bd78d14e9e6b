// Where the robot stands is free, whatever its sensors can see of it: they look away from it, so that the place where a
// robot began stays unknown until it comes back. (Costmaps of mobile robots clear the footprint for the same reason.)
#pragma once

#include <span>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::sonar_model {

class ClearedFootprint {
 public:
  // What a cell under the robot is set to: free, and no more sure than that takes.
  static constexpr LogOdds kFree = -200;

  // Of a robot that takes no room: no cells.
  ClearedFootprint() = default;
  explicit ClearedFootprint(const RobotModel& robot);

  // The cells that are unknown and belong to the largest disc round the robot's origin that its footprint holds, or
  // are a cell beside it and do not look occupied: planners ask for the room of whole cells. Nothing once more before
  // the robot has moved half a cell, nor where the grid cannot grow to. Rows rising; valid until the next call.
  [[nodiscard]] std::span<const Cell> unknown_under(const OccupancyGrid& grid, const Pose2& T_map_robot);
  // Sets these to kFree, a span each.
  void take(OccupancyGrid& grid, const Pose2& T_map_robot, std::vector<CellSpan>& changed);

 private:
  double radius_m_ = 0.0;
  bool has_stood_ = false;
  Point last_m_{0.0, 0.0};
  std::vector<Cell> cells_;
};

}  // namespace cairn::sonar_model
