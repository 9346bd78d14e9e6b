#include "framework/host/mission_map.hpp"

#include <string>

namespace cairn {

SavedMap map_of_mission(const Mission& mission, const OccupancyGrid& grid, const LandmarkKeeper& keeper,
                        ClusterTree clusters) {
  SavedMap map;
  map.grid = grid;
  map.graph = keeper.graph();
  map.clusters = std::move(clusters);
  map.shapes = mission.shapes;
  map.driven_path = keeper.driven_path();
  map.properties = {{"mission", mission.config.mission},
                    {"seed", std::to_string(mission.config.seed)},
                    {"robot", mission.robot.name},
                    {"robot_radius_m", std::to_string(mission.robot.radius_m)}};
  return map;
}

}  // namespace cairn
