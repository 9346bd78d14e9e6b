// The YAML file of ROS map_server with its picture -> occupancy grid.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/config/config_value.hpp"
#include "maps/exchange/grids/map_server.hpp"

namespace cairn {

struct MapServerFile {
  MapServerSettings settings;
  std::filesystem::path picture;      // relative ones are taken from the folder of the file
  SourcePlace picture_place;          // where the file names it
  std::vector<std::string> warnings;  // each with its place, "file:line:column: " or "file: "
};

// Keys as nav2_map_server has them: image, resolution, origin [x, y, yaw], negate (0, 1, true, false), occupied_thresh,
// free_thresh, and mode (trinary, scale, raw), the only one that may be left out. Throws ConfigError.
[[nodiscard]] MapServerFile parse_map_server_yaml(const std::string& text, const std::string& file_name);

// Where the picture may be that a file names. Outside the file's own folder it could be any file of whoever reads a map
// that comes from elsewhere.
enum class PictureFolder { own, any };

// Warnings begin with the file. Throws ConfigError for the YAML file and a picture that cannot be read, ExchangeError
// for what is in the picture.
[[nodiscard]] ImportedGrid load_map_server(const std::filesystem::path& file,
                                           PictureFolder pictures = PictureFolder::own);

}  // namespace cairn
