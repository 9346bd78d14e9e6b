// What a mission saves.
#pragma once

#include "framework/landmarks/tracker.hpp"
#include "framework/mission/mission.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// Which mission, seed, robot and world.
[[nodiscard]] std::map<std::string, std::string> properties_of(const Mission& mission);
// The tracker's candidates are part of the progress.
[[nodiscard]] SavedMap map_of_mission(const Mission& mission, const OccupancyGrid& grid, const LandmarkTracker& tracker,
                                      ClusterTree clusters, MissionProgress progress);

}  // namespace cairn
