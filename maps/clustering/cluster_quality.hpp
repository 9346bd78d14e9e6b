// How good the clusters of a network are, level by level.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "maps/clustering/clustering.hpp"

namespace cairn {

struct LevelQuality {
  int level = 1;
  std::size_t clusters = 0;
  std::size_t routes_cut = 0;      // from one cluster to another, open or closed
  std::size_t boundary = 0;        // landmarks at their ends
  std::int32_t largest = 0;        // landmarks of a cluster
  double mean = 0.0;               // landmarks of a cluster
  std::optional<double> diameter;  // the longest of a cluster's cheapest ways inside, mean over the clusters
  [[nodiscard]] double balance_ratio() const { return static_cast<double>(largest) / mean; }  // 1 is best
};

// From level 1 up; nothing without levels. Diameters, in the network's costs, only of levels without a cluster above
// `max_for_diameter` landmarks (every landmark of a cluster is searched from); pairs without a way inside count as 0.
[[nodiscard]] std::vector<LevelQuality> cluster_quality(const Network& network, const Clustering& clustering,
                                                        std::int32_t max_for_diameter = 128);

}  // namespace cairn
