// Coordinate reference systems by name: a map's coordinates are metres, never degrees.
#pragma once

#include <string_view>

namespace cairn::exchange {

// EPSG:3857, as nav2 writes it for "metres in the map frame".
[[nodiscard]] bool is_nav2_crs(std::string_view name);
// One whose coordinates are degrees of longitude and latitude (CRS84, EPSG:4326 and the like).
[[nodiscard]] bool is_geographic_crs(std::string_view name);

}  // namespace cairn::exchange
