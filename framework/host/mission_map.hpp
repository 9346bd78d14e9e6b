// What a mission saves.
#pragma once

#include "framework/host/landmark_keeper.hpp"
#include "framework/host/mission.hpp"
#include "maps/map_store.hpp"

namespace cairn {

[[nodiscard]] SavedMap map_of_mission(const Mission& mission, const OccupancyGrid& grid, const LandmarkKeeper& keeper,
                                      ClusterTree clusters);

}  // namespace cairn
