// What planners and behaviours may see. Read-only; valid during the call only.
#pragma once

#include <cstdint>
#include <optional>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/view/speed_law.hpp"
#include "maps/geometry/map_move.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class CellSource;
class Hierarchies;

struct WorldView {
  const OccupancyGrid& grid;
  const LandmarkGraph& graph;
  const RobotModel& robot;
  PoseEstimate pose;
  double time_s = 0.0;                       // of the mission's clock
  const Observation* observation = nullptr;  // the latest, null when planning against a saved map
  // The collision monitor has cut this share of the last wanted speed: 0 none, 1 all.
  double speed_reduction_ratio = 0.0;
  const Hierarchies* hierarchies = nullptr;  // of the graph; null: searches take the graph as it is
  // Where this is the same number and not 0, so is what the grid holds. Never the same for two grids that one planner
  // sees.
  std::uint64_t grid_version = 0;
  const CellSource* cells = nullptr;  // of a grid that is not whole in memory; null: it is
  Pose2 T_map_start{};                // where the mission began; a mission that was resumed, where it began at first
  // How fast the robot may go beside obstacles; none where the robot that will drive is not known.
  std::optional<SpeedLaw> speed_law{};
  // How often the map was exchanged for another that has places elsewhere: who keeps places of the map from tick to
  // tick moves or drops them when this number has risen (docs/behaviours.md).
  std::uint64_t map_moves = 0;
  // How places moved with the last exchange; null: none of the map before has a place in this one.
  const MapMove* last_map_move = nullptr;
};

}  // namespace cairn
