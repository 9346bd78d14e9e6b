#include "framework/mission/saved_content.hpp"

#include <string>

namespace cairn {

std::map<std::string, std::string> properties_of(const Mission& mission) {
  std::map<std::string, std::string> properties{{"mission", mission.config.mission},
                                                {"seed", std::to_string(mission.config.seed)},
                                                {"robot", mission.robot.name},
                                                {"robot_radius_m", std::to_string(mission.robot.radius_m)}};
  properties[kClustersProperty] = text_of(mission.config.clusters);
  if (!mission.world_fingerprint.empty()) properties["world"] = mission.world_fingerprint;
  return properties;
}

SavedMap map_of_mission(const Mission& mission, const OccupancyGrid& grid, const LandmarkTracker& tracker,
                        ClusterTree clusters, MissionProgress progress) {
  SavedMap map;
  map.grid = grid;
  map.graph = tracker.graph();
  map.clusters = std::move(clusters);
  map.shapes = mission.shapes;
  map.driven_path = tracker.driven_path();
  map.properties = properties_of(mission);
  map.progress = std::move(progress);
  map.progress->candidates = tracker.candidates();
  return map;
}

}  // namespace cairn
