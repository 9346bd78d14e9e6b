// Road networks of the Transportation Networks for Research collection, as landmark graphs.
#pragma once

#include <filesystem>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// From NAME_net.tntp.gz and NAME_node.tntp.gz: node 17 becomes landmark 17 at its coordinates, each link a one-way
// route that costs its length; whatever their units are. Throws std::runtime_error when a file is missing or broken.
[[nodiscard]] LandmarkGraph road_network(const std::filesystem::path& folder, const std::string& name);

}  // namespace cairn
