// The YAML file of ROS map_server with its picture -> occupancy grid.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "maps/exchange/map_server.hpp"

namespace cairn {

struct MapServerFile {
  MapServerSettings settings;
  std::filesystem::path picture;  // relative ones are taken from the folder of the file
  std::vector<std::string> warnings;
};

// Keys as nav2_map_server has them: image, resolution, origin [x, y, yaw], negate (0, 1, true, false), occupied_thresh,
// free_thresh, and mode (trinary, scale, raw), the only one that may be left out. Throws ConfigError.
[[nodiscard]] MapServerFile parse_map_server_yaml(const std::string& text, const std::string& file_name);

// Throws ConfigError for the YAML file, ExchangeError for the picture.
[[nodiscard]] ImportedGrid load_map_server(const std::filesystem::path& file);

}  // namespace cairn
