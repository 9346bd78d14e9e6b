// The poses of a route as bytes of the saved map.
#pragma once

#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn::store {

// A trajectory of whole steps (see in_whole_steps) takes its differences, any other its little-endian doubles
// x_m, y_m, theta_rad, compressed; nothing for none. The first byte says which.
[[nodiscard]] std::string packed_trajectory(const std::vector<Pose2>& trajectory);
// The same poses to the bit. Throws StoreError when the bytes do not hold exactly that many.
[[nodiscard]] std::vector<Pose2> unpacked_trajectory(const std::string& packed, std::size_t poses);

}  // namespace cairn::store
