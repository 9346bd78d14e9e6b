// What there is to draw of a saved map.
#pragma once

#include "maps/pictures/map_picture.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// Grid, graph, clusters and the driven path. The map must outlive it.
[[nodiscard]] MapPicture picture_of(const SavedMap& map);

}  // namespace cairn
