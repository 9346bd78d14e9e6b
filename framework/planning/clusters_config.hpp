// The settings under `clusters` of a mission, which its saved map keeps.
#pragma once

#include <map>
#include <string>

#include "framework/config/fields.hpp"
#include "maps/clustering/clustering.hpp"

namespace cairn {

struct ClustersConfig {
  int from_landmarks = 8;       // fewer have no clusters
  int max_landmarks = 32;       // of a cluster of the lowest level
  int growth = 4;               // a cluster one level up may hold this many times as many
  double narrow_below_m = 1.3;  // passages of routes that divide clusters
  int large_from = 300;         // landmarks from which clusters are made for searches
  static void describe(Fields<ClustersConfig>& fields);
  [[nodiscard]] ClusterSizes sizes() const;
};

// What a saved map keeps of them, among its properties.
inline constexpr const char* kClustersProperty = "clusters";
[[nodiscard]] std::string text_of(const ClustersConfig& config);
// As the map's properties say; the default sizes where they say nothing. Throws ConfigError on a text that is none.
[[nodiscard]] ClusterSizes cluster_sizes_of(const std::map<std::string, std::string>& properties);

}  // namespace cairn
