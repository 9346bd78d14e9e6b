// Occupancy grids of ROS map_server: a grey picture and what its YAML file says about it (the file itself is read by
// framework/config/map_server_file.hpp).
#pragma once

#include "maps/exchange/grids/grey_picture.hpp"
#include "maps/exchange/grids/imported_grid.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

inline constexpr std::uint8_t kUnknownGrey = 205;  // as map_server writes it

enum class MapServerMode { trinary, scale, raw };

struct MapServerSettings {
  MapServerMode mode = MapServerMode::trinary;
  double resolution_m = 0.05;  // side of a pixel
  Pose2 origin;                // of the lower left corner of the lower left pixel, in the map
  bool negate = false;         // white is occupied
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;  // at most occupied_thresh
};

// With p = 1 - grey/255 (grey/255 when negated):
//   trinary  p >= occupied_thresh is occupied, p <= free_thresh free (and that counts when both hold), else unknown
//   scale    the same, and what lies between is occupied with a probability that rises from 0 to 1, in steps of 0.01
//   raw      a grey of 0 ... 100 is the probability in percent, any other unknown; negate and alpha say nothing
// In trinary and scale a pixel that is not opaque is unknown. Occupied and free are at the clamp of the log-odds.
// The grid's axes are the map's. When the origin is turned, a cell gets the most occupied of what it covers of the
// picture, and a warning says so: walls get up to a cell thicker, never thinner.
// Throws ExchangeError when a turned picture needs more cells than a grid can have.
[[nodiscard]] ImportedGrid grid_of(const GreyPicture& picture, const MapServerSettings& settings,
                                   const std::string& file_name);

}  // namespace cairn
