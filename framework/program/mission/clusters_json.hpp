// The clusters of a map, as JSON: for those who look at it.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "maps/clustering/cluster_tree.hpp"

namespace cairn {

[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<ListedCluster>& clusters);

}  // namespace cairn
