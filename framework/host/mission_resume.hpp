// Going on with a mission from the map that it has saved.
#pragma once

#include "framework/host/mission.hpp"
#include "maps/map_store.hpp"

namespace cairn {

// The seed that the map was made with. Throws StoreError when it does not say.
[[nodiscard]] std::int64_t seed_of(const SavedMap& map);

// Throws StoreError with what does not fit, without the map's name: the map was not saved by a mission, or by
// another one, with another robot or seed, or with other steps.
void check_resumable(const SavedMap& map, const Mission& mission);

// Throws StoreError when the mission's map module makes grids of other cells than the saved one has.
void check_same_cells(const OccupancyGrid& saved, const OccupancyGrid& of_mission);

}  // namespace cairn
