// A saved map as the view's page asks for it.
#pragma once

#include <string>
#include <vector>

#include "maps/store/map_store.hpp"

namespace cairn {

// The levels of detail that are handed out: cells a side of which one byte is made, finest first. None: an empty grid.
[[nodiscard]] std::vector<int> view_levels(const OccupancyGrid& grid);
// One byte for level x level cells, row by row from the lowest y: the highest ol of those that are known (walls stay),
// kUnknownOl where none is. Not for an empty grid.
[[nodiscard]] std::string view_cells(const OccupancyGrid& grid, int level);

// JSON texts. Lengths in metres, angles in radians, cells by their index.
[[nodiscard]] std::string view_map_json(const SavedMap& map, const OccupancyGrid& grid, const std::string& name);
[[nodiscard]] std::string view_landmarks_json(const LandmarkGraph& graph);
[[nodiscard]] std::string view_routes_json(const LandmarkGraph& graph);
[[nodiscard]] std::string view_clusters_json(const ClusterTree& tree, const LandmarkGraph& graph);

}  // namespace cairn
