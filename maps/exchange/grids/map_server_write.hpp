// Occupancy grids as ROS map_server keeps them: what grid_of() of map_server.hpp reads, written.
#pragma once

#include <string>
#include <vector>

#include "maps/exchange/grids/map_server.hpp"

namespace cairn {

struct ExportedGrid {
  GreyPicture picture;
  MapServerSettings settings;
  std::vector<std::string> warnings;  // sentences: what the mode cannot hold
};

// All cells of grid.bounds(), the highest row first.
//   trinary  free 254, occupied 0, else 205; thresholds 0.65 and 0.196, by which 205 stays unknown
//   scale    grey 255 (100 - percent)/100, unknown is transparent; thresholds 1 and 0, so that every percent comes back
//   raw      the percent, unknown 255
// Free and occupied are those of OccupancyThresholds. The percent is of the cell's probability; 0 and 100 stand for
// log-odds of 4 nat and more, as grid_of() reads them, and unknown is a log-odds of 0. What grid_of() made of a trinary
// or raw picture comes back cell by cell, in trinary, scale and raw alike when it knew only free, occupied and unknown.
// Throws std::invalid_argument when the grid has no cells.
[[nodiscard]] ExportedGrid map_server_of(const OccupancyGrid& grid, MapServerMode mode);

// The YAML file beside the picture, keys in map_server's order; numbers read back as the same.
[[nodiscard]] std::string map_server_yaml_of(const MapServerSettings& settings, const std::string& picture_file);

}  // namespace cairn
